#include "core/math/rotation.h"

#include <algorithm>

namespace dhcal {

Eigen::Vector3d LogSO3(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();  // sin(angle / 2)
  if (sine < 1e-9) return 2.0 * q.vec();
  return q.vec() * (2.0 * std::atan2(sine, q.w()) / sine);
}

Eigen::Matrix3d LeftJacobianInverseSO3(const Eigen::Vector3d& r) {
  const double t2 = r.squaredNorm();
  // 1/t^2 - (1 + cos t)/(2 t sin t); the series is exact to 1e-16 below t = 0.01.
  double c = 1.0 / 12.0 + t2 / 720.0 + t2 * t2 / 30240.0;
  if (t2 > 1e-4) {
    const double half = 0.5 * std::sqrt(t2);
    c = (1.0 - half / std::tan(half)) / t2;
  }
  const Eigen::Matrix3d S = Skew<double>(r);
  return Eigen::Matrix3d::Identity() - 0.5 * S + c * S * S;
}

Eigen::Matrix3d RotationFromRpy(const Eigen::Vector3d& rpy) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(rpy.z(), Vector3d::UnitZ()) * AngleAxisd(rpy.y(), Vector3d::UnitY()) *
          AngleAxisd(rpy.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d RpyFromRotation(const Eigen::Matrix3d& R) {
  const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), cos_pitch);
  if (cos_pitch < 1e-12) {
    // Only yaw -+ roll is determined; choose roll = 0.
    return {0.0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  }
  // The roll that is left once this very yaw is undone: exact together with it, even where the yaw
  // itself is badly determined.
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  const double s = std::sin(yaw), c = std::cos(yaw);
  return {std::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1)), pitch, yaw};
}

}  // namespace dhcal
