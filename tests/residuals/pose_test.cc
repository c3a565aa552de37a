#include "residuals/pose.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/residuals/cached_rows.h"

namespace dhcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

Eigen::Isometry3d Predicted(const PoseCache& cache, int row_idx) {
  Eigen::Isometry3d X_WQ = Eigen::Isometry3d::Identity();
  X_WQ.linear() = cache.R_WQ(row_idx);
  X_WQ.translation() = cache.p_WQ(row_idx);
  return X_WQ;
}

TEST(PoseResidual, IsShiftAndTurnFromMeasuredToPredictedOverTheirSigmas) {
  const OneArmRows rows({kPi / 2});  // Q at (0, 1, 0), turned by 90 deg about z
  const Eigen::Isometry3d measured = MakeFrame({0.2, 1, -0.1}, {0, 0, 60 * kDegree});
  const PoseResidual block(&rows.cache, 0, measured, 0.1, 10 * kDegree);
  const BlockValues values = Evaluate(block);
  ASSERT_TRUE(values.valid);
  VectorXd r(6), J(6);
  r << -2, 0, 1, 0, 0, 3;
  J << -10, 0, 0, 0, 0, 1 / (10 * kDegree);
  EXPECT_THAT(values.r, MatrixNear(r, 1e-14));
  EXPECT_THAT(values.J, MatrixNear(J, 1e-14));
}

TEST(PoseResidual, SeesTheTurnInTheWorldFrame) {
  // Measured: a quarter turn about W's z; predicted: that, then 0.3 about W's x.
  const Matrix3d measured = ExpSO3<double>(Vector3d(0, 0, kPi / 2));
  const Matrix3d predicted = ExpSO3<double>(Vector3d(0.3, 0, 0)) * measured;
  EXPECT_THAT(PoseResidual::RotationError(predicted, measured),
              MatrixNear(Vector3d(0.3, 0, 0), 1e-15));
}

TEST(PoseResidual, IsZeroWhereTheReadingWasTaken) {
  Rng rng(1);
  CachedRows rows(Panda(), 2, &rng);
  rows.MoveTo(rows.state_vector(), false);
  const PoseResidual block(&rows.cache, 1, Predicted(rows.cache, 1), 1e-3, 1e-3);
  EXPECT_THAT(Evaluate(block, false).r, MatrixNear(VectorXd::Zero(6), 1e-12));  // 1e-15 over sigma
}

TEST(PoseResidual, DerivativesAreRiddersDifferences) {
  for (const TestRobot& robot : TestRobots()) {
    SCOPED_TRACE(robot.model.name);
    Rng rng(2);
    CachedRows rows(robot.model, 2, &rng);
    rows.MoveTo(rows.state_vector(), false);
    for (const int row_idx : {0, 1}) {
      // Turned by 0.5, so that up to 0.2 in each parameter stays clear of pi.
      const Eigen::Isometry3d measured =
          MakeFrame({0.1, 0.2, -0.3}, {0.3, -0.4, 0}) * Predicted(rows.cache, row_idx);
      const PoseResidual block(&rows.cache, row_idx, measured, 0.5, 0.7);
      ExpectRiddersDerivatives(block, row_idx, &rows, &rng);
    }
  }
}

TEST(PoseResidual, IsSmoothWhereTheTurnIsZero) {
  Rng rng(3);
  CachedRows rows(Kr15(), 1, &rng);
  const VectorXd zero = rows.state_vector();
  rows.MoveTo(zero, true);
  const PoseResidual block(&rows.cache, 0, Predicted(rows.cache, 0), 1.0, 1.0);
  const BlockValues values = Evaluate(block);
  ASSERT_TRUE(values.valid);
  EXPECT_THAT(values.r, MatrixNear(VectorXd::Zero(6), 1e-15));
  // The turn itself, neither zero nor not-a-number.
  EXPECT_THAT(values.J.bottomRows(3), MatrixNear(rows.cache.J_w(0), 1e-15));
  ExpectRiddersDerivatives(block, 0, &rows, &rng);
  // The same slope from both sides: no kink as that of an angle's absolute value.
  const int theta1 = 0;
  constexpr double kStep = 1e-6;
  VectorXd slope[2];
  for (const int side : {0, 1}) {
    VectorXd x = zero;
    x[theta1] = side == 0 ? -kStep : kStep;
    rows.MoveTo(x, false);
    slope[side] = Evaluate(block, false).r.tail(3) / x[theta1];
  }
  EXPECT_THAT(slope[0], MatrixNear(slope[1], 1e-8));  // rounding over step
}

TEST(PoseResidual, IsDifferentiableUpToHalfATurn) {
  const double turn = kPi - 0.01;
  const OneArmRows rows({turn});
  const PoseResidual block(&rows.cache, 0, Eigen::Isometry3d::Identity(), 1.0, 1.0);
  const BlockValues values = Evaluate(block);
  ASSERT_TRUE(values.valid);
  EXPECT_THAT(values.r.tail(3), MatrixNear(Vector3d(0, 0, turn), 1e-14));
  EXPECT_THAT(values.J.bottomRows(3), MatrixNear(Vector3d(0, 0, 1), 1e-14));
}

}  // namespace
}  // namespace dhcal
