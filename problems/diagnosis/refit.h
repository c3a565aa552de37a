// The names that a search gave, fitted together with the geometry and judged.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_REFIT_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_REFIT_H_

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/model/diagnosis.h"
#include "problems/diagnosis/complete_fit.h"

namespace dhcal {

struct Refitted {
  /// Geometry and all effects that hold, together; null where none does.
  std::unique_ptr<CompleteFit> fit;
  /// Something significant is left: a name was taken back, or the fit stays above the noise.
  bool rest_left = false;
};

/// Fits the names with the geometry and takes back those that rows not fitted speak against, until
/// all that are left predict them. An effect whose shape rests on stated masses is given its own
/// moments where the masses do not bring the fit down. Adds findings and totals to the diagnosis.
Refitted RefitAndJudge(const ProblemSpec& spec,
                       const Recording& recording,
                       const std::vector<Reading>& fitted,
                       std::vector<EffectRequest> names,
                       const std::function<void(const std::string&)>& say,
                       DiagnosisResult* diagnosis);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_REFIT_H_
