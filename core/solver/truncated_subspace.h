// The directions that a truncation keeps, as a manifold: Ceres then steps in them alone.
#ifndef DHCAL_CORE_SOLVER_TRUNCATED_SUBSPACE_H_
#define DHCAL_CORE_SOLVER_TRUNCATED_SUBSPACE_H_

#include <Eigen/Core>
#include <ceres/manifold.h>

#include "core/math/truncated_svd.h"

namespace dhcal {

/// x (+) y = x + D V_k y with D the scale of the columns and V_k the kept right singular vectors:
/// y counts in tolerances. Ceres lifts a covariance C of y to D V_k C V_k' D, which is the kept
/// part of the parameters' covariance.
class TruncatedSubspace final : public ceres::Manifold {
 public:
  /// At least one direction must be kept.
  explicit TruncatedSubspace(const TruncatedSvd& svd)
      : basis_(svd.scale.asDiagonal() * svd.kept()),
        inverse_(svd.kept().transpose() * svd.scale.cwiseInverse().asDiagonal()) {}

  int AmbientSize() const override { return static_cast<int>(basis_.rows()); }
  int TangentSize() const override { return static_cast<int>(basis_.cols()); }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    Map(x_plus_delta, AmbientSize()) =
        ConstMap(x, AmbientSize()) + basis_ * ConstMap(delta, TangentSize());
    return true;
  }
  bool PlusJacobian(const double* /*x*/, double* jacobian) const override {
    RowMajor(jacobian, AmbientSize(), TangentSize()) = basis_;
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Map(y_minus_x, TangentSize()) =
        inverse_ * (ConstMap(y, AmbientSize()) - ConstMap(x, AmbientSize()));
    return true;
  }
  bool MinusJacobian(const double* /*x*/, double* jacobian) const override {
    RowMajor(jacobian, TangentSize(), AmbientSize()) = inverse_;
    return true;
  }

 private:
  using Map = Eigen::Map<Eigen::VectorXd>;
  using ConstMap = Eigen::Map<const Eigen::VectorXd>;
  using RowMajor =
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

  Eigen::MatrixXd basis_;    // n x k
  Eigen::MatrixXd inverse_;  // k x n
};

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_TRUNCATED_SUBSPACE_H_
