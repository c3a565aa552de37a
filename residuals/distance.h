// Residual of a distance reading (ball bar, draw wire, interferometer).
//
//   h(x) = |p_WQ(x) - p_WA|               from the measured point Q to the anchor A [m]
//   r(x) = (h - distance) / sigma, 1 row
//
// Not differentiable where Q meets the anchor; there the block says so and the step is rejected.
#ifndef DHCAL_RESIDUALS_DISTANCE_H_
#define DHCAL_RESIDUALS_DISTANCE_H_

#include "residuals/cached_residual.h"

namespace dhcal {

class DistanceResidual final : public CachedResidual {
 public:
  /// `p_WA` anchor [m], `distance` [m], `sigma` [m].
  DistanceResidual(const PoseCache* cache,
                   int row_idx,
                   const Eigen::Vector3d& p_WA,
                   double distance,
                   double sigma)
      : CachedResidual(cache, row_idx, Eigen::VectorXd::Constant(1, sigma)),
        p_WA_(p_WA),
        distance_(distance) {}

 protected:
  bool Compare(Difference* difference, Derivative* J) const override {
    const Eigen::Vector3d p_AQ_W = cache().p_WQ(row_idx()) - p_WA_;
    const double length = p_AQ_W.norm();
    if (length < kSmallestDistance) return false;
    (*difference)[0] = length - distance_;
    if (J != nullptr) *J = (p_AQ_W / length).transpose() * cache().J_p(row_idx());
    return true;
  }

 private:
  static constexpr double kSmallestDistance = 1e-9;  // [m]

  Eigen::Vector3d p_WA_;
  double distance_;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_DISTANCE_H_
