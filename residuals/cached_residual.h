// Base of all residual blocks that compare a reading with a cached pose.
//
//   residual = (h(x) - measured) / sigma        rows of unit variance, no unit
//
// Whitening is written here once; a measurement kind supplies only the difference and its
// derivative. Parameter blocks: one scalar per parameter in the row's scope, in that order.
#ifndef DHCAL_RESIDUALS_CACHED_RESIDUAL_H_
#define DHCAL_RESIDUALS_CACHED_RESIDUAL_H_

#include <Eigen/Core>
#include <ceres/cost_function.h>

#include "residuals/pose_cache.h"

namespace dhcal {

class CachedResidual : public ceres::CostFunction {
 public:
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const final;

 protected:
  // Rows: 1 (distance), 3 (position) or 6 (pose).
  using Difference = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1>;
  using Derivative = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor>;

  /// `sigma`: standard deviation of each row, in the row's unit. The cache must outlive the block.
  CachedResidual(const PoseCache* cache, int row_idx, const Eigen::VectorXd& sigma);

  /// Predicted minus measured; `J` (null = not wanted) is rows x scope parameters, preset to the
  /// right size. Returns false where the reading is not differentiable.
  virtual bool Compare(Difference* difference, Derivative* J) const = 0;

  const PoseCache& cache() const { return *cache_; }
  int row_idx() const { return row_idx_; }

 private:
  const PoseCache* cache_;
  int row_idx_;
  Difference inverse_sigma_;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_CACHED_RESIDUAL_H_
