// A frame that the problem file leaves out and that the file's own parameters imitate, but only
// with corrections that no manufacture has: the residuals are silent, the corrections speak. (The
// paper's Tables I and II print no tool, yet its Table III needs one of 0.2 m: without it d6 comes
// out 200 mm too long.)
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_CONCEALED_FRAME_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_CONCEALED_FRAME_H_

#include <memory>
#include <vector>

#include "core/model/diagnosis.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/completions.h"
#include "problems/diagnosis/held_fit.h"

namespace dhcal {

/// Findings, notes and moved parameters: a finding for each of the completions (of the file's
/// parameters to those of `complete`) whose freedom makes implausible corrections of `identified`
/// needless.
DiagnosisResult ConcealedFrames(const ProblemSpec& spec,
                                const Recording& recording,
                                const Result& identified,
                                const CompleteFit& complete,
                                const std::vector<Completion>& completions);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_CONCEALED_FRAME_H_
