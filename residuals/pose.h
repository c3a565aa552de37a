// Residual of a position and orientation reading (6-D).
//
//   rows 0-2: (p_WQ - p_WQ_measured) / sigma                          [m / m]
//   rows 3-5: Log(R_WQ R_WQ_measured') / sigma_rotation, in W         [rad / rad]
//
// The rotation error is a 3-vector, smooth at zero (a scalar angle has no derivative there). Not
// differentiable where it reaches pi. d Log(Exp(w) R) = J_l^-1(Log R) w: Sola et al. (2018), eq.
// 144.
#ifndef DHCAL_RESIDUALS_POSE_H_
#define DHCAL_RESIDUALS_POSE_H_

#include "core/math/rotation.h"
#include "residuals/cached_residual.h"

namespace dhcal {

class PoseResidual final : public CachedResidual {
 public:
  /// `X_WQ` measured; `sigma` of one coordinate [m], `sigma_rotation` of one component [rad].
  PoseResidual(const PoseCache* cache,
               int row_idx,
               const Eigen::Isometry3d& X_WQ,
               double sigma,
               double sigma_rotation)
      : CachedResidual(cache, row_idx, Sigmas(sigma, sigma_rotation)),
        p_WQ_(X_WQ.translation()),
        R_WQ_(X_WQ.linear()) {}

  /// Log(R R_measured') [rad], the difference that rows 3-5 whiten.
  static Eigen::Vector3d RotationError(const Eigen::Matrix3d& R_WQ,
                                       const Eigen::Matrix3d& R_WQ_measured) {
    return LogSO3(R_WQ * R_WQ_measured.transpose());
  }

 protected:
  bool Compare(Difference* difference, Derivative* J) const override {
    const Eigen::Vector3d turn = RotationError(cache().R_WQ(row_idx()), R_WQ_);
    difference->head<3>() = cache().p_WQ(row_idx()) - p_WQ_;
    difference->tail<3>() = turn;
    if (J != nullptr) {
      J->topRows<3>() = cache().J_p(row_idx());
      J->bottomRows<3>() = LeftJacobianInverseSO3(turn) * cache().J_w(row_idx());
    }
    return true;
  }

 private:
  static Eigen::VectorXd Sigmas(double sigma, double sigma_rotation) {
    Eigen::VectorXd sigmas(6);
    sigmas << Eigen::Vector3d::Constant(sigma), Eigen::Vector3d::Constant(sigma_rotation);
    return sigmas;
  }

  Eigen::Vector3d p_WQ_;
  Eigen::Matrix3d R_WQ_;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_POSE_H_
