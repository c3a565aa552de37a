// Residual of an absolute position reading.
//
//   h(x) = p_WQ(x)                        predicted position of the measured point Q in W [m]
//   r(x) = (p_WQ - p_WQ_measured) / sigma, 3 rows
//
// Differentiable everywhere. English et al. (2004), eq. (11) with the sign of a residual.
#ifndef DHCAL_RESIDUALS_POSITION_H_
#define DHCAL_RESIDUALS_POSITION_H_

#include "residuals/cached_residual.h"

namespace dhcal {

class PositionResidual final : public CachedResidual {
 public:
  /// `measured` p_WQ [m], `sigma` of one coordinate [m].
  PositionResidual(const PoseCache* cache,
                   int row_idx,
                   const Eigen::Vector3d& measured,
                   double sigma)
      : CachedResidual(cache, row_idx, Eigen::Vector3d::Constant(sigma)), measured_(measured) {}

 protected:
  bool Compare(Difference* difference, Derivative* J) const override {
    *difference = cache().p_WQ(row_idx()) - measured_;
    if (J != nullptr) *J = cache().J_p(row_idx());
    return true;
  }

 private:
  Eigen::Vector3d measured_;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_POSITION_H_
