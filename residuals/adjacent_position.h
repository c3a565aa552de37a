// Residuals of a displacement between two adjacent poses, one block per pair.
//
// AdjacentPositionResidual: each displacement was read afresh (independent noise).
//   h(x) = p_WQ,k(x) - p_WQ,k-1(x)        displacement of the measured point Q in W [m]
//   r(x) = (h - d_k) / sigma, 3 rows
//
// SharedAdjacentPositionResidual: a pose's reading error enters both of its differences. Exact
// whitening turns the pair's difference into a contrast with all earlier poses of the run
// (running_means.h); the pair's own displacement is the new information in it.
//   r(x) = ((p_k - mean p_<k) - (y_k - mean y_<k)) / contrast sigma, 3 rows
//
// Both differentiable everywhere. English et al. (2004), step 1 of the nine.
#ifndef DHCAL_RESIDUALS_ADJACENT_POSITION_H_
#define DHCAL_RESIDUALS_ADJACENT_POSITION_H_

#include "residuals/cached_residual.h"

namespace dhcal {

class AdjacentPositionResidual final : public CachedResidual {
 public:
  /// `displacement` from row `previous_idx` to `row_idx` [m], both in one scope; `sigma` [m].
  AdjacentPositionResidual(const PoseCache* cache,
                           int previous_idx,
                           int row_idx,
                           const Eigen::Vector3d& displacement,
                           double sigma)
      : CachedResidual(cache, row_idx, Eigen::Vector3d::Constant(sigma)),
        previous_idx_(previous_idx),
        displacement_(displacement) {}

 protected:
  bool Compare(Difference* difference, Derivative* J) const override {
    *difference = cache().p_WQ(row_idx()) - cache().p_WQ(previous_idx_) - displacement_;
    if (J != nullptr) *J = cache().J_p(row_idx()) - cache().J_p(previous_idx_);
    return true;
  }

 private:
  int previous_idx_;
  Eigen::Vector3d displacement_;
};

class SharedAdjacentPositionResidual final : public CachedResidual {
 public:
  /// `contrast` = measured position minus the mean of the run's earlier ones [m], weighted as the
  /// cache's running means are.
  SharedAdjacentPositionResidual(const PoseCache* cache,
                                 int row_idx,
                                 const Eigen::Vector3d& contrast)
      : CachedResidual(
            cache, row_idx, Eigen::Vector3d::Constant(cache->means().contrast_sigma(row_idx))),
        contrast_(contrast) {}

 protected:
  bool Compare(Difference* difference, Derivative* J) const override {
    const RunningMeans& means = cache().means();
    *difference = cache().p_WQ(row_idx()) - means.p_mean(row_idx()) - contrast_;
    if (J != nullptr) *J = cache().J_p(row_idx()) - means.J_mean(row_idx(), J->cols());
    return true;
  }

 private:
  Eigen::Vector3d contrast_;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_ADJACENT_POSITION_H_
