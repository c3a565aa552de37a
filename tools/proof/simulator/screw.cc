#include "tools/proof/simulator/screw.h"

#include <cmath>

namespace dhcal::concealed {
namespace {

Eigen::Matrix3d Cross(const Eigen::Vector3d& w) {
  Eigen::Matrix3d matrix;
  matrix << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return matrix;
}

/// Rodrigues' formula; w of unit length.
Eigen::Matrix3d Turn(const Eigen::Vector3d& w, double angle) {
  const Eigen::Matrix3d W = Cross(w);
  return Eigen::Matrix3d::Identity() + std::sin(angle) * W + (1 - std::cos(angle)) * W * W;
}

}  // namespace

Screw AxisThrough(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d w = direction.normalized();
  return {w, -w.cross(point)};
}

Screw SlideAlong(const Eigen::Vector3d& direction) {
  return {Eigen::Vector3d::Zero(), direction.normalized()};
}

Eigen::Isometry3d Exp(const Screw& axis, double amount) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (axis.w.isZero()) {
    X.translation() = amount * axis.v;
    return X;
  }
  const Eigen::Matrix3d R = Turn(axis.w, amount);
  X.linear() = R;
  X.translation() = (Eigen::Matrix3d::Identity() - R) * axis.w.cross(axis.v) +
                    amount * axis.w * axis.w.dot(axis.v);
  return X;
}

Eigen::Isometry3d Displacement(const Eigen::Vector3d& rotation,
                               const Eigen::Vector3d& translation) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const double angle = rotation.norm();
  if (angle > 0) X.linear() = Turn(rotation / angle, angle);
  X.translation() = translation;
  return X;
}

}  // namespace dhcal::concealed
