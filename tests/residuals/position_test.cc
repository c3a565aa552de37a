#include "residuals/position.h"

#include <gtest/gtest.h>

#include "tests/residuals/cached_rows.h"

namespace dhcal {
namespace {

using Eigen::Vector3d;

TEST(PositionResidual, IsPredictedMinusMeasuredOverSigma) {
  const OneArmRows rows({0.0});  // Q at (1, 0, 0)
  const PositionResidual block(&rows.cache, 0, Vector3d(0.9, 0, 0.2), 0.1);
  const BlockValues values = Evaluate(block);
  ASSERT_TRUE(values.valid);
  EXPECT_THAT(values.r, MatrixNear(Vector3d(1, 0, -2), 1e-14));
  EXPECT_THAT(values.J, MatrixNear(Vector3d(0, 10, 0), 1e-14));  // 1 m per rad along y
}

TEST(PositionResidual, IsZeroWhereTheReadingWasTaken) {
  Rng rng(1);
  CachedRows rows(Kr15(), 2, &rng);
  rows.MoveTo(rows.state_vector(), false);
  const PositionResidual block(&rows.cache, 1, Vector3d(rows.cache.p_WQ(1)), 1e-5);
  EXPECT_EQ(Evaluate(block, false).r, Vector3d::Zero());
}

TEST(PositionResidual, DerivativesAreRiddersDifferences) {
  for (const TestRobot& robot : TestRobots()) {
    SCOPED_TRACE(robot.model.name);
    Rng rng(2);
    CachedRows rows(robot.model, 2, &rng);
    for (const int row_idx : {0, 1}) {
      const PositionResidual block(&rows.cache, row_idx, Vector3d(0.3, -0.1, 0.8), 0.5);
      ExpectRiddersDerivatives(block, row_idx, &rows, &rng);
    }
  }
}

TEST(CachedResidual, LeavesOutColumnsThatAreNotWanted) {
  const OneArmRows rows({0.0});
  const PositionResidual block(&rows.cache, 0, Vector3d::Zero(), 0.1);
  const double unused = 0;
  const double* const parameters[] = {&unused};
  double residuals[3];
  double* jacobians[] = {nullptr};
  EXPECT_TRUE(block.Evaluate(parameters, residuals, jacobians));
  EXPECT_DOUBLE_EQ(residuals[0], 10.0);
}

TEST(CachedResidualDeathTest, RefusesSigmaZero) {
  const OneArmRows rows({0.0});
  EXPECT_DEATH(PositionResidual(&rows.cache, 0, Vector3d::Zero(), 0.0), "sigma");
}

}  // namespace
}  // namespace dhcal
