// Rotation vectors. Exp, Log and the left Jacobian, smooth at zero also for ceres::Jet.
// Source: Sola, Deray, Atchuthan, "A micro Lie theory", arXiv 1812.01537, eqs. 132-145.
#ifndef DHCAL_CORE_MATH_ROTATION_H_
#define DHCAL_CORE_MATH_ROTATION_H_

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace dhcal {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

/// [v]x, so that Skew(v) * w = v x w.
template <typename T>
Matrix3<T> Skew(const Vector3<T>& v) {
  Matrix3<T> m;
  m << T(0), -v.z(), v.y(), v.z(), T(0), -v.x(), -v.y(), v.x(), T(0);
  return m;
}

namespace internal {

/// sin(t)/t, (1 - cos t)/t^2 and (t - sin t)/t^3 from t^2. The series keeps the derivative at
/// zero, which a branch to the identity would lose.
template <typename T>
struct RotationCoefficients {
  T sinc, versine, cubic;

  explicit RotationCoefficients(const T& t2) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    if (t2 < T(1e-4)) {
      // Next terms are below 1e-17 relative.
      sinc = T(1) - t2 / T(6) * (T(1) - t2 / T(20) * (T(1) - t2 / T(42)));
      versine = T(0.5) - t2 / T(24) * (T(1) - t2 / T(30) * (T(1) - t2 / T(56)));
      cubic = T(1) / T(6) - t2 / T(120) * (T(1) - t2 / T(42) * (T(1) - t2 / T(72)));
    } else {
      const T t = sqrt(t2);
      sinc = sin(t) / t;
      versine = (T(1) - cos(t)) / t2;
      cubic = (t - sin(t)) / (t2 * t);
    }
  }
};

}  // namespace internal

/// Rotation matrix of a rotation vector r [rad].
template <typename T>
Matrix3<T> ExpSO3(const Vector3<T>& r) {
  const internal::RotationCoefficients<T> c(r.squaredNorm());
  const Matrix3<T> S = Skew<T>(r);
  return Matrix3<T>::Identity() + c.sinc * S + c.versine * (S * S);
}

/// Left Jacobian: Exp(r + dr) = Exp(J_l(r) dr) Exp(r) to first order.
template <typename T>
Matrix3<T> LeftJacobianSO3(const Vector3<T>& r) {
  const internal::RotationCoefficients<T> c(r.squaredNorm());
  const Matrix3<T> S = Skew<T>(r);
  return Matrix3<T>::Identity() + c.versine * S + c.cubic * (S * S);
}

/// Rotation vector [rad] of R, of length at most pi. Through the quaternion, which is well
/// conditioned up to and including pi.
Eigen::Vector3d LogSO3(const Eigen::Matrix3d& R);

/// Inverse of the left Jacobian: Log(Exp(dr) Exp(r)) = r + J_l^-1(r) dr to first order.
Eigen::Matrix3d LeftJacobianInverseSO3(const Eigen::Vector3d& r);

/// R = Rz(yaw) Ry(pitch) Rx(roll), angles [rad]: turns about the fixed x, then y, then z.
Eigen::Matrix3d RotationFromRpy(const Eigen::Vector3d& rpy);

/// Roll, pitch, yaw [rad] that give R back to rounding, also close to pitch = +-90 deg, where only
/// roll -+ yaw is determined; right there, roll is zero.
Eigen::Vector3d RpyFromRotation(const Eigen::Matrix3d& R);

}  // namespace dhcal

#endif  // DHCAL_CORE_MATH_ROTATION_H_
