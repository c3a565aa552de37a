// Forward kinematics of a serial chain and its analytic derivative with respect to every slot.
//
//   X_WQ = X_WB(base) * A_1 * ... * A_n * X_TQ(tool)                     English et al. (2004) (1)
//   standard: A_i = Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta)
//   modified: A_i = Rx(alpha) Tx(a) Ry(beta) Rz(theta) Tz(d)
//
// Frames and conventions: core/NOTATION.md. The derivative is geometric: a factor that turns about
// a unit axis u through o moves the point p by u x (p - o) per radian and turns the frame by u; a
// factor that shifts along u moves p by u per metre.
#ifndef DHCAL_CORE_KINEMATICS_DH_CHAIN_H_
#define DHCAL_CORE_KINEMATICS_DH_CHAIN_H_

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/kinematics/slots.h"
#include "core/math/rotation.h"
#include "core/model/robot.h"

namespace dhcal {

/// The fixed frames at the two ends, which may differ from row to row (runs, targets).
struct EndFrames {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_TQ = Eigen::Isometry3d::Identity();
};

/// Pose of Q in W and its derivatives.
struct PoseWithDerivatives {
  Eigen::Vector3d p_WQ;  // [m]
  Eigen::Matrix3d R_WQ;
  Eigen::Matrix<double, 3, Eigen::Dynamic> J_p;  // d p_WQ / d slot, 3 x slots
  Eigen::Matrix<double, 3, Eigen::Dynamic> J_w;  // rotation of Q in W per slot, 3 x slots [rad]
};

/// The nominal chain; immutable.
class DhChain {
 public:
  explicit DhChain(const RobotModel& robot);

  const SlotLayout& slots() const { return slots_; }
  int num_joints() const { return slots_.num_joints(); }

  /// Pose X_WQ for the joint coordinates `q` [rad or m] (n, as the controller reports them) and
  /// the perturbation `delta` of every slot (slots().size()). Templated for ceres::Jet.
  template <typename T>
  Eigen::Transform<T, 3, Eigen::Isometry> Pose(const Eigen::Ref<const Eigen::VectorXd>& q,
                                               const Eigen::Matrix<T, Eigen::Dynamic, 1>& delta,
                                               const EndFrames& ends) const;

  /// The same with analytic derivatives with respect to every slot at (q, delta).
  void PoseAndDerivatives(const Eigen::Ref<const Eigen::VectorXd>& q,
                          const Eigen::Ref<const Eigen::VectorXd>& delta,
                          const EndFrames& ends,
                          PoseWithDerivatives* pose) const;

  /// Pose of the flange in the base, X_BT, with `delta` of the joints' slots only.
  Eigen::Isometry3d FlangePose(const Eigen::Ref<const Eigen::VectorXd>& q,
                               const Eigen::Ref<const Eigen::VectorXd>& delta) const;

  /// Frames in the base of the base itself and of every link, n + 1 in order: X_BB, X_BL1, ...
  std::vector<Eigen::Isometry3d> LinkFrames(const Eigen::Ref<const Eigen::VectorXd>& q) const;
  /// The same with `delta` (slots().size()) added to the joints' slots.
  std::vector<Eigen::Isometry3d> LinkFrames(const Eigen::Ref<const Eigen::VectorXd>& q,
                                            const Eigen::Ref<const Eigen::VectorXd>& delta) const;

 private:
  template <typename T>
  struct Row {
    T theta, d, a, alpha, beta;
  };

  /// A_i of a row.
  template <typename T>
  Eigen::Transform<T, 3, Eigen::Isometry> LinkTransform(const Row<T>& row) const;

  template <typename T>
  Row<T> RowAt(int joint_idx,
               double q,
               const Eigen::Ref<const Eigen::Matrix<T, Eigen::Dynamic, 1>>& delta) const;

  RobotModel robot_;
  SlotLayout slots_;
};

/// X perturbed by a frame slot's six numbers: translation added, rotation Exp(r) from the left,
/// both in X's parent frame.
template <typename T>
Eigen::Transform<T, 3, Eigen::Isometry> PerturbFrame(const Eigen::Isometry3d& X,
                                                     const Eigen::Matrix<T, 6, 1>& delta) {
  Eigen::Transform<T, 3, Eigen::Isometry> result;
  result.setIdentity();
  result.linear() = ExpSO3<T>(delta.template tail<3>()) * X.linear().cast<T>();
  result.translation() = X.translation().cast<T>() + delta.template head<3>();
  return result;
}

// Implementation of the templates.

template <typename T>
DhChain::Row<T> DhChain::RowAt(
    int joint_idx,
    double q,
    const Eigen::Ref<const Eigen::Matrix<T, Eigen::Dynamic, 1>>& delta) const {
  const JointRow& row = robot_.joints[static_cast<std::size_t>(joint_idx)];
  const bool revolute = row.type == JointType::kRevolute;
  const auto slot = [&](JointSlot kind) { return delta[slots_.joint(joint_idx, kind)]; };
  return {T(row.theta + (revolute ? row.sign * q : 0.0)) + slot(JointSlot::kTheta),
          T(row.d + (revolute ? 0.0 : row.sign * q)) + slot(JointSlot::kD),
          T(row.a) + slot(JointSlot::kA),
          T(row.alpha) + slot(JointSlot::kAlpha),
          T(row.beta) + slot(JointSlot::kBeta)};
}

template <typename T>
Eigen::Transform<T, 3, Eigen::Isometry> DhChain::LinkTransform(const Row<T>& row) const {
  using Transform = Eigen::Transform<T, 3, Eigen::Isometry>;
  const auto about = [](const T& angle, const Vector3<T>& axis) {
    return Transform(Eigen::AngleAxis<T>(angle, axis));
  };
  const auto along = [](const Vector3<T>& shift) {
    return Transform(Eigen::Translation<T, 3>(shift));
  };
  const Vector3<T> x = Vector3<T>::UnitX(), y = Vector3<T>::UnitY(), z = Vector3<T>::UnitZ();
  if (robot_.convention == DhConvention::kStandard) {
    return about(row.theta, z) * along(z * row.d + x * row.a) * about(row.alpha, x) *
           about(row.beta, y);
  }
  return about(row.alpha, x) * along(x * row.a) * about(row.beta, y) * about(row.theta, z) *
         along(z * row.d);
}

template <typename T>
Eigen::Transform<T, 3, Eigen::Isometry> DhChain::Pose(
    const Eigen::Ref<const Eigen::VectorXd>& q,
    const Eigen::Matrix<T, Eigen::Dynamic, 1>& delta,
    const EndFrames& ends) const {
  Eigen::Transform<T, 3, Eigen::Isometry> X =
      PerturbFrame<T>(ends.X_WB, delta.template segment<6>(slots_.base(0)));
  for (int i = 0; i < num_joints(); ++i) X = X * LinkTransform<T>(RowAt<T>(i, q[i], delta));
  return X * PerturbFrame<T>(ends.X_TQ, delta.template segment<6>(slots_.tool(0)));
}

}  // namespace dhcal

#endif  // DHCAL_CORE_KINEMATICS_DH_CHAIN_H_
