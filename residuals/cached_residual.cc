#include "residuals/cached_residual.h"

#include <glog/logging.h>

namespace dhcal {

CachedResidual::CachedResidual(const PoseCache* cache, int row_idx, const Eigen::VectorXd& sigma)
    : cache_(cache), row_idx_(row_idx), inverse_sigma_(sigma.cwiseInverse()) {
  CHECK((sigma.array() > 0).all());
  set_num_residuals(static_cast<int>(sigma.size()));
  mutable_parameter_block_sizes()->assign(cache->scope(row_idx).parameters.size(), 1);
}

bool CachedResidual::Evaluate(double const* const* /*parameters*/,
                              double* residuals,
                              double** jacobians) const {
  Difference difference(num_residuals());
  Derivative J;
  if (jacobians != nullptr) {
    J.resize(num_residuals(), static_cast<Eigen::Index>(parameter_block_sizes().size()));
  }
  if (!Compare(&difference, jacobians == nullptr ? nullptr : &J)) return false;
  Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = inverse_sigma_.cwiseProduct(difference);
  if (jacobians == nullptr) return true;
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    if (jacobians[k] == nullptr) continue;
    Eigen::Map<Eigen::VectorXd>(jacobians[k], num_residuals()) =
        inverse_sigma_.cwiseProduct(J.col(k));
  }
  return true;
}

}  // namespace dhcal
