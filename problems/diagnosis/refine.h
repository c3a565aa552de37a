// Settings that are not parameters (an order, an instant, a time constant), found to the resolution
// that the rows allow.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_REFINE_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_REFINE_H_

#include <Eigen/Core>

#include "problems/diagnosis/hypotheses.h"

namespace dhcal {

/// True for effects with an instant or a time constant.
bool HasScannedSetting(const EffectRequest& request);

/// The request with the instant or time constant that removes most beside geometry and `extra`.
EffectRequest RefineSetting(const HypothesisSpace& space,
                            const EffectRequest& request,
                            const Eigen::MatrixXd& extra);

/// The order near `order` that removes most.
double RefineOrder(const HypothesisSpace& space, const EffectRequest& request, double order);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_REFINE_H_
