// What a careful reader would remark on a finished run: figures of the input that its own readings
// contradict.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_REMARKS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_REMARKS_H_

#include <string>
#include <vector>

#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"

namespace dhcal {

/// How many times wider the sigmas of parameters are than a fit of independent rows with the stated
/// noise says.
struct Widening {
  double by_noise = 1;  // that residuals without any pattern contradict
  double by_poses = 1;  // of which the rows err alike

  double all() const { return by_noise * by_poses; }
};
Widening WideningOf(const Recording& recording, const Result& result);

/// Sentences on a stated noise that the residuals contradict, joint coordinates too coarse for the
/// readings, and test rows that are no unseen ones. Empty where there is nothing to remark.
std::vector<std::string> Remarks(const ProblemSpec& spec,
                                 const Recording& recording,
                                 const Result& result,
                                 const Widening& widening);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_REMARKS_H_
