// A whole run: geometry as the problem file asks, whether that can be one, diagnosis, rows that are
// misread taken out of both, and the model that the diagnosis announces.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_CALIBRATE_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_CALIBRATE_H_

#include <functional>
#include <optional>

#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"
#include "problems/progress.h"
#include "problems/setup/cause.h"

namespace dhcal {

/// Who wants to know of a run before it ends; each may be empty.
struct Watch {
  Progress progress;
  /// Called with the geometry of the problem file, before the diagnosis begins, as a result of its
  /// own whose notes say that the diagnosis is missing; not where none follows.
  std::function<void(const Result&)> geometry;
};

/// The inputs have been checked. Files that cannot belong together end in a result that says why
/// and holds no calibration; where one cure is certain, `cured` (may be null) gets the files with
/// it. A fault of the diagnosis, or of what follows it, keeps the calibration, and the result says
/// so.
Result Calibrate(const ProblemSpec& spec,
                 const Recording& recording,
                 const Watch& watch,
                 std::optional<CuredFiles>* cured = nullptr);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_CALIBRATE_H_
