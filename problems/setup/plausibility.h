// The gate before a result: whether the files can belong together, and whether what was fitted can
// be a calibration.
#ifndef DHCAL_PROBLEMS_SETUP_PLAUSIBILITY_H_
#define DHCAL_PROBLEMS_SETUP_PLAUSIBILITY_H_

#include <optional>

#include "core/model/result.h"
#include "problems/setup/doctor.h"

namespace dhcal {

/// Judges a finished fit of the files; where it is refused, looks for the cause.
struct SetupJudgement {
  SetupResult setup;
  std::optional<CuredFiles> cured;  // where one cure is certain
};
SetupJudgement JudgeSetup(const ProblemSpec& spec,
                          const Recording& recording,
                          const Result& identified);

/// Takes everything out of a result that could be taken for a calibration.
void Refuse(Result* result);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_PLAUSIBILITY_H_
