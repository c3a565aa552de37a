// A forward kinematics written apart from the product, to judge it by: plain 4 x 4 homogeneous
// matrices, entry by entry from the textbooks, and rotations from the exponential series. It shares
// with the product only the robot's data and the order of the slots.
//
// Every operation is analytic in the scalar, so that it also runs with std::complex<double>: the
// complex step Im f(x + ih) / h has no cancellation and gives derivatives to the last digits.
#ifndef DHCAL_TESTS_SUPPORT_INDEPENDENT_KINEMATICS_H_
#define DHCAL_TESTS_SUPPORT_INDEPENDENT_KINEMATICS_H_

#include <cmath>
#include <complex>
#include <cstddef>

#include <Eigen/Core>

#include "core/model/robot.h"

namespace dhcal::independent {

template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
template <typename T>
using Matrix4 = Eigen::Matrix<T, 4, 4>;
template <typename T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

/// Spong, Hutchinson, Vidyasagar, "Robot Modeling and Control" (2006), eq. (3.10).
template <typename T>
Matrix4<T> StandardRow(const T& theta, const T& d, const T& a, const T& alpha) {
  using std::cos;
  using std::sin;
  const T ct = cos(theta), st = sin(theta), ca = cos(alpha), sa = sin(alpha);
  Matrix4<T> A;
  A << ct, -st * ca, st * sa, a * ct,  //
      st, ct * ca, -ct * sa, a * st,   //
      T(0), sa, ca, d,                 //
      T(0), T(0), T(0), T(1);
  return A;
}

/// Craig, "Introduction to Robotics" (2005), eq. (3.6); alpha and a are those of the row before in
/// Craig's counting.
template <typename T>
Matrix4<T> ModifiedRow(const T& theta, const T& d, const T& a, const T& alpha) {
  using std::cos;
  using std::sin;
  const T ct = cos(theta), st = sin(theta), ca = cos(alpha), sa = sin(alpha);
  Matrix4<T> A;
  A << ct, -st, T(0), a,               //
      st * ca, ct * ca, -sa, -d * sa,  //
      st * sa, ct * sa, ca, d * ca,    //
      T(0), T(0), T(0), T(1);
  return A;
}

/// Hayati's turn about y.
template <typename T>
Matrix4<T> TurnAboutY(const T& beta) {
  using std::cos;
  using std::sin;
  const T c = cos(beta), s = sin(beta);
  Matrix4<T> A;
  A << c, T(0), s, T(0),       //
      T(0), T(1), T(0), T(0),  //
      -s, T(0), c, T(0),       //
      T(0), T(0), T(0), T(1);
  return A;
}

/// Rotation matrix of a rotation vector: I + K + K^2/2! + ..., K = [r]x, until the terms have
/// vanished (for |r| <= 2 pi the 60th is below 1e-34).
template <typename T>
Matrix3<T> RotationOf(const T& x, const T& y, const T& z) {
  Matrix3<T> K;
  K << T(0), -z, y, z, T(0), -x, -y, x, T(0);
  Matrix3<T> sum = Matrix3<T>::Identity(), term = Matrix3<T>::Identity();
  for (int n = 1; n <= 60; ++n) {
    term = (term * K / T(n)).eval();
    sum += term;
  }
  return sum;
}

/// A fixed frame moved by six numbers, shift x y z and rotation vector x y z, both in its parent.
template <typename T>
Matrix4<T> Moved(const Eigen::Isometry3d& X, const Vector<T>& delta, Eigen::Index first) {
  Matrix4<T> shift = Matrix4<T>::Identity(), turn = Matrix4<T>::Identity();
  Matrix4<T> R = Matrix4<T>::Identity(), p = Matrix4<T>::Identity();
  for (int row = 0; row < 3; ++row) {
    shift(row, 3) = delta[first + row];
    p(row, 3) = T(X.matrix()(row, 3));
    for (int col = 0; col < 3; ++col) R(row, col) = T(X.matrix()(row, col));
  }
  turn.template topLeftCorner<3, 3>() =
      RotationOf<T>(delta[first + 3], delta[first + 4], delta[first + 5]);
  return shift * p * turn * R;
}

/// One joint's matrix at the coordinate `q`; its slots theta, d, a, alpha, beta start at `first`.
template <typename T>
Matrix4<T> Row(DhConvention convention,
               const JointRow& joint,
               double q,
               const Vector<T>& delta,
               Eigen::Index first) {
  const bool slides = joint.type == JointType::kPrismatic;
  const T theta = joint.theta + (slides ? 0.0 : joint.sign * q) + delta[first];
  const T d = joint.d + (slides ? joint.sign * q : 0.0) + delta[first + 1];
  const T a = joint.a + delta[first + 2];
  const T alpha = joint.alpha + delta[first + 3];
  const T beta = joint.beta + delta[first + 4];
  if (convention == DhConvention::kStandard) {
    return StandardRow<T>(theta, d, a, alpha) * TurnAboutY<T>(beta);
  }
  // Craig's matrix cut in two where beta belongs: between Tx(a) and Rz(theta).
  return ModifiedRow<T>(T(0), T(0), a, alpha) * TurnAboutY<T>(beta) *
         ModifiedRow<T>(theta, d, T(0), T(0));
}

/// X_WQ with the base at `X_WB` and the tool at `X_TQ`. Slots: five per joint, then six of the
/// base, six of the tool.
template <typename T>
Matrix4<T> ForwardKinematics(const RobotModel& robot,
                             const Eigen::VectorXd& q,
                             const Vector<T>& delta,
                             const Eigen::Isometry3d& X_WB,
                             const Eigen::Isometry3d& X_TQ) {
  const Eigen::Index n = q.size();
  Matrix4<T> X = Moved<T>(X_WB, delta, 5 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const JointRow& joint = robot.joints[static_cast<std::size_t>(i)];
    X = (X * Row<T>(robot.convention, joint, q[i], delta, 5 * i)).eval();
  }
  return X * Moved<T>(X_TQ, delta, 5 * n + 6);
}

/// With the robot's own base and tool.
template <typename T>
Matrix4<T> ForwardKinematics(const RobotModel& robot,
                             const Eigen::VectorXd& q,
                             const Vector<T>& delta) {
  return ForwardKinematics<T>(robot, q, delta, robot.X_WB, robot.X_TQ);
}

/// Movement of Q and turn of its frame, both in W, per slot.
struct SlotDerivatives {
  Eigen::Matrix3Xd J_p;
  Eigen::Matrix3Xd J_w;
};

/// By the complex step 1e-30, which vanishes against every real part.
inline SlotDerivatives ComplexStep(const RobotModel& robot,
                                   const Eigen::VectorXd& q,
                                   const Eigen::VectorXd& delta) {
  using Complex = std::complex<double>;
  constexpr double kStep = 1e-30;
  const Eigen::Index size = delta.size();
  SlotDerivatives J{Eigen::Matrix3Xd(3, size), Eigen::Matrix3Xd(3, size)};
  for (Eigen::Index slot = 0; slot < size; ++slot) {
    Vector<Complex> moved = delta.cast<Complex>();
    moved[slot] += Complex(0, kStep);
    const Matrix4<Complex> X = ForwardKinematics<Complex>(robot, q, moved);
    J.J_p.col(slot) = X.imag().topRightCorner<3, 1>() / kStep;
    const Eigen::Matrix3d R = X.real().topLeftCorner<3, 3>();
    const Eigen::Matrix3d w = X.imag().topLeftCorner<3, 3>() / kStep * R.transpose();  // [w]x
    J.J_w.col(slot) << w(2, 1), w(0, 2), w(1, 0);
  }
  return J;
}

}  // namespace dhcal::independent

#endif  // DHCAL_TESTS_SUPPORT_INDEPENDENT_KINEMATICS_H_
