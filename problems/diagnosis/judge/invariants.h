// What no report may say: contradictions between the parts of a diagnosis.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_INVARIANTS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_INVARIANTS_H_

#include <string>
#include <vector>

#include "core/model/diagnosis.h"

namespace dhcal {

/// A sentence for each thing that the result's parts contradict each other in; empty = none.
///   - a finding's probability is below the false-alarm rate, and one of its values two standard
///     deviations from zero
///   - no finding of an impossible sign, or beyond a hundred usual sizes (as its cautions say)
///   - the verdict goes with the findings, their alternatives and the rest
///   - the unexplained fraction is that of the printed RMS, and more than 0 where something is left
///   - the rows set aside are as many as are listed
///   - totals belong to the findings: nothing moved, no model and no gain without any
///   - all numbers are finite where they are given, and probabilities are probabilities
std::vector<std::string> Contradictions(const DiagnosisResult& d);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_INVARIANTS_H_
