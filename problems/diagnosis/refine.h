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

/// Orders closer than this cannot be told apart over the joint's range: 2 pi / range.
double OrderResolution(const PhysicsContext& context, int joint);

/// The order within half a resolution that removes most beside geometry and `extra`.
double RefineOrder(const HypothesisSpace& space,
                   const EffectRequest& request,
                   double order,
                   const Eigen::MatrixXd& extra);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_REFINE_H_
