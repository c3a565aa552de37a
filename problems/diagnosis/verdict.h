// From the outcome of the search and the refit to one of the five verdicts.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_VERDICT_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_VERDICT_H_

#include "core/model/diagnosis.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/search.h"

namespace dhcal {

/// Lists the alternatives, what is left and what is hidden, and says which verdict that makes.
/// `rest_left`: names that fit were taken back, or their refit stays above the noise.
void Conclude(const CompleteFit& geometry,
              const HypothesisSpace& space,
              const SearchOutcome& outcome,
              bool rest_left,
              DiagnosisResult* diagnosis);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_VERDICT_H_
