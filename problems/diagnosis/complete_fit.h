// The complete geometry, alone or together with effects, fitted by Ceres: what every claim of a
// diagnosis is measured against (PHYSICS.md X1, M2).
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_COMPLETE_FIT_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_COMPLETE_FIT_H_

#include <memory>
#include <vector>

#include "problems/calibration.h"
#include "problems/fit.h"

namespace dhcal {

/// A problem with every geometric freedom estimated. Not copyable: the calibration refers to spec.
struct CompleteFit {
  CompleteFit(const ProblemSpec& user_spec, const Recording& recording);
  CompleteFit(const CompleteFit&) = delete;
  CompleteFit& operator=(const CompleteFit&) = delete;

  ProblemSpec spec;  // the user's, with `estimate: complete`, no priors, no robust loss
  Calibration calibration;
  Fit fit;

  const Eigen::VectorXd& state() const { return fit.summary.state; }
  bool usable() const { return fit.summary.IsSolutionUsable(); }
};

/// Fits geometry and `effects` (besides those of the problem file) from the aligned start. `near`
/// (may be null): a fit of the same readings with other effects, from which a fit with curves
/// starts, since each of its rounds takes seconds on thousands of rows.
std::unique_ptr<CompleteFit> FitComplete(const ProblemSpec& spec,
                                         const Recording& recording,
                                         const std::vector<EffectRequest>& effects,
                                         const Progress& progress,
                                         const CompleteFit* near = nullptr);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_COMPLETE_FIT_H_
