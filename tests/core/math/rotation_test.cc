#include "core/math/rotation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/LU>
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/matchers.h"

namespace dhcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Jet3 = ceres::Jet<double, 3>;

constexpr double kRounding = 4e-15;  // a few roundings of numbers of size one

Vector3d RandomAxis(Rng* rng) {
  return Vector3d(rng->Normal(), rng->Normal(), rng->Normal()).normalized();
}

/// Zero, tiny, both sides of the switch from series to closed form at 0.01, ordinary, at pi and
/// around it, beyond.
std::vector<double> Angles() {
  return {0.0,        1e-300,       1e-16,        1e-12, 1e-9,       1e-8, 1e-5,
          1e-3,       0.01 - 1e-12, 0.01 + 1e-12, 0.02,  0.3,        1.0,  2.0,
          kPi - 1e-3, kPi - 1e-8,   kPi - 1e-12,  kPi,   kPi + 1e-8, 4.0,  6.0};
}

Matrix3d SeriesExp(const Vector3d& r) {
  return independent::RotationOf<double>(r.x(), r.y(), r.z());
}

/// Column k is w with dR/dr_k = [w]x R: the left Jacobian by its definition, by complex steps.
Matrix3d ComplexStepLeftJacobian(const Vector3d& r) {
  using Complex = std::complex<double>;
  constexpr double kStep = 1e-30;
  Matrix3d J;
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3cd moved = r.cast<Complex>();
    moved[k] += Complex(0, kStep);
    const Eigen::Matrix3cd R = independent::RotationOf<Complex>(moved.x(), moved.y(), moved.z());
    const Matrix3d w = R.imag() / kStep * Matrix3d(R.real()).transpose();
    J.col(k) << w(2, 1), w(0, 2), w(1, 0);
  }
  return J;
}

Eigen::Matrix<Jet3, 3, 1> Variable(const Vector3d& r) {
  return {Jet3(r.x(), 0), Jet3(r.y(), 1), Jet3(r.z(), 2)};
}

TEST(Skew, IsTheCrossProduct) {
  const Vector3d v(0.3, -0.7, 1.9), w(-1.1, 0.4, 0.2);
  EXPECT_THAT(Skew<double>(v) * w, MatrixNear(v.cross(w), 1e-15));
}

TEST(ExpSO3, QuarterTurnAboutZMovesXToY) {
  const Matrix3d R = ExpSO3<double>(Vector3d(0, 0, kPi / 2));
  EXPECT_THAT(R.col(0), MatrixNear(Vector3d::UnitY(), 1e-15));
  EXPECT_THAT(R.col(1), MatrixNear(-Vector3d::UnitX(), 1e-15));
}

TEST(ExpSO3, EqualsTheExponentialSeriesAtAllAngles) {
  Rng rng(1);
  for (const double angle : Angles()) {
    const Vector3d r = angle * RandomAxis(&rng);
    // The series itself rounds terms as large as angle^n / n!, 65 at angle 6.
    const double tolerance = kRounding * std::max(1.0, std::exp(angle) / 10);
    EXPECT_THAT(ExpSO3<double>(r), MatrixNear(SeriesExp(r), tolerance)) << "angle " << angle;
  }
}

TEST(ExpSO3, IsOrthonormalAndRightHanded) {
  Rng rng(2);
  for (const double angle : Angles()) {
    const Matrix3d R = ExpSO3<double>(angle * RandomAxis(&rng));
    EXPECT_THAT(R * R.transpose(), MatrixNear(Matrix3d::Identity(), kRounding)) << angle;
    EXPECT_NEAR(R.determinant(), 1.0, kRounding) << angle;
  }
}

TEST(ExpSO3, KeepsItsDerivativeExactlyAtZeroForJets) {
  const Matrix3<Jet3> R = ExpSO3<Jet3>(Variable(Vector3d::Zero()));
  for (int k = 0; k < 3; ++k) {
    const Matrix3d dR = R.unaryExpr([k](const Jet3& x) { return x.v[k]; });
    EXPECT_EQ(dR, Skew<double>(Vector3d::Unit(k)));  // exact: d Exp(r) at zero is [e_k]x
  }
}

TEST(ExpSO3, JetDerivativeIsTheLeftJacobianAtAllAngles) {
  Rng rng(3);
  for (const double angle : Angles()) {
    const Vector3d r = angle * RandomAxis(&rng);
    const Matrix3<Jet3> R = ExpSO3<Jet3>(Variable(r));
    Matrix3d J;
    for (int k = 0; k < 3; ++k) {
      const Matrix3d w = R.unaryExpr([k](const Jet3& x) { return x.v[k]; }) *
                         R.unaryExpr([](const Jet3& x) { return x.a; }).transpose();
      J.col(k) << w(2, 1), w(0, 2), w(1, 0);
    }
    // Just above the switch the closed form divides a rounding 1e-16 by angle^2 = 1e-4, and the
    // derivative once more by the angle, times entries of size angle^2.
    EXPECT_THAT(J, MatrixNear(LeftJacobianSO3<double>(r), 1e-12)) << "angle " << angle;
  }
}

TEST(LeftJacobianSO3, EqualsComplexStepsOfTheExponentialSeries) {
  Rng rng(4);
  for (const double angle : Angles()) {
    const Vector3d r = angle * RandomAxis(&rng);
    const double tolerance = kRounding * std::max(1.0, std::exp(angle) / 5);
    EXPECT_THAT(LeftJacobianSO3<double>(r), MatrixNear(ComplexStepLeftJacobian(r), tolerance))
        << "angle " << angle;
  }
}

TEST(LeftJacobianSO3, HasHalfTheCrossProductAsDerivativeAtZeroForJets) {
  const Matrix3<Jet3> J = LeftJacobianSO3<Jet3>(Variable(Vector3d::Zero()));
  for (int k = 0; k < 3; ++k) {
    const Matrix3d dJ = J.unaryExpr([k](const Jet3& x) { return x.v[k]; });
    EXPECT_EQ(dJ, 0.5 * Skew<double>(Vector3d::Unit(k)));
  }
}

TEST(LeftJacobianInverseSO3, IsTheInverseUpToPi) {
  Rng rng(5);
  for (const double angle : Angles()) {
    if (angle > kPi) continue;
    const Vector3d r = angle * RandomAxis(&rng);
    EXPECT_THAT(LeftJacobianInverseSO3(r) * LeftJacobianSO3<double>(r),
                MatrixNear(Matrix3d::Identity(), kRounding))
        << "angle " << angle;
  }
}

TEST(LogSO3, OfTheIdentityIsExactlyZero) {
  EXPECT_EQ(LogSO3(Matrix3d::Identity()), Vector3d::Zero());
}

TEST(LogSO3, UndoesExpBelowPi) {
  Rng rng(6);
  for (const double angle : Angles()) {
    if (angle >= kPi) continue;
    for (int i = 0; i < 8; ++i) {  // near pi the largest component and its sign decide the way
      const Vector3d r = angle * RandomAxis(&rng);
      // Tiny rotation vectors stand in R to full relative precision, off the diagonal.
      const double tolerance = kRounding * std::min(angle, 1.0) + 1e-300;
      EXPECT_THAT(LogSO3(ExpSO3<double>(r)), MatrixNear(r, tolerance)) << "angle " << angle;
    }
  }
}

TEST(LogSO3, AtPiGivesOneOfTheTwoRotationVectors) {
  Rng rng(7);
  std::vector<Vector3d> axes = {Vector3d::UnitX(),
                                Vector3d::UnitY(),
                                Vector3d::UnitZ(),
                                Vector3d(1, 1, 0).normalized(),
                                Vector3d(-1, 0, 1).normalized()};
  for (int i = 0; i < 20; ++i) axes.push_back(RandomAxis(&rng));
  for (const Vector3d& axis : axes) {
    const Matrix3d R = 2.0 * axis * axis.transpose() - Matrix3d::Identity();
    const Vector3d r = LogSO3(R);
    EXPECT_NEAR(r.norm(), kPi, kRounding);
    EXPECT_THAT(r.normalized() * r.normalized().dot(axis), MatrixNear(axis, kRounding));
  }
}

TEST(LogSO3, BeyondPiGivesTheShorterTurn) {
  const Vector3d axis = Vector3d(1, -2, 2) / 3;
  EXPECT_THAT(LogSO3(ExpSO3<double>(4.0 * axis)), MatrixNear((4.0 - 2 * kPi) * axis, kRounding));
}

TEST(LogSO3, HasTheInverseLeftJacobianAsDerivative) {
  Rng rng(8);
  constexpr double kStep = 1e-5;  // truncation 1e-10, rounding 1e-16 / 1e-5
  for (const double angle : {0.0, 1e-8, 0.5, 2.0, kPi - 0.01}) {
    const Vector3d r = angle * RandomAxis(&rng);
    const Matrix3d R = ExpSO3<double>(r);
    Matrix3d J;
    for (int k = 0; k < 3; ++k) {
      const Vector3d dw = kStep * Vector3d::Unit(k);
      J.col(k) = (LogSO3(ExpSO3<double>(dw) * R) - LogSO3(ExpSO3<double>(-dw) * R)) / (2 * kStep);
    }
    EXPECT_THAT(LeftJacobianInverseSO3(r), MatrixNear(J, 1e-9)) << "angle " << angle;
  }
}

}  // namespace
}  // namespace dhcal
