#include "residuals/distance.h"

#include <cmath>

#include <ceres/problem.h>
#include <gtest/gtest.h>

#include "tests/residuals/cached_rows.h"

namespace dhcal {
namespace {

using Eigen::Vector3d;

TEST(DistanceResidual, IsPredictedMinusMeasuredOverSigma) {
  const OneArmRows rows({0.0});  // Q at (1, 0, 0), 5 from (1, -3, 4)
  const DistanceResidual block(&rows.cache, 0, Vector3d(1, -3, 4), 4.9, 0.05);
  const BlockValues values = Evaluate(block);
  ASSERT_TRUE(values.valid);
  EXPECT_NEAR(values.r[0], 2.0, 1e-13);
  EXPECT_NEAR(values.J(0, 0), 0.6 / 0.05, 1e-13);  // moving along y at 1 m per rad, 3 of 5 of it
}

TEST(DistanceResidual, IsZeroWhereTheReadingWasTaken) {
  Rng rng(1);
  CachedRows rows(Kr15(), 1, &rng);
  rows.MoveTo(rows.state_vector(), false);
  const Vector3d anchor(2, 1, -1);
  const double distance = (rows.cache.p_WQ(0) - anchor).norm();
  EXPECT_EQ(Evaluate(DistanceResidual(&rows.cache, 0, anchor, distance, 1e-5), false).r[0], 0.0);
}

TEST(DistanceResidual, DerivativesAreRiddersDifferences) {
  for (const TestRobot& robot : TestRobots()) {
    SCOPED_TRACE(robot.model.name);
    Rng rng(2);
    CachedRows rows(robot.model, 2, &rng);
    for (const int row_idx : {0, 1}) {
      // Further away than the robots reach: a distance bends near its anchor.
      const DistanceResidual block(&rows.cache, row_idx, Vector3d(5, 4, -3), 6.5, 0.5);
      ExpectRiddersDerivatives(block, row_idx, &rows, &rng);
    }
  }
}

TEST(DistanceResidual, RefusesWhereThePointMeetsTheAnchor) {
  const OneArmRows rows({0.0});
  const DistanceResidual at(&rows.cache, 0, Vector3d(1, 0, 0), 0.3, 0.1);
  EXPECT_FALSE(Evaluate(at, true).valid);
  EXPECT_FALSE(Evaluate(at, false).valid);
  const DistanceResidual beside(&rows.cache, 0, Vector3d(1, 1e-6, 0), 0.3, 0.1);
  const BlockValues values = Evaluate(beside);
  EXPECT_TRUE(values.valid);
  EXPECT_NEAR(values.J(0, 0), -10.0, 1e-8);  // straight away from the anchor still
}

TEST(DistanceResidual, MakesCeresRefuseThePoint) {
  OneArmRows rows({0.0});
  ceres::Problem::Options options;
  options.evaluation_callback = &rows.cache;
  ceres::Problem problem(options);
  problem.AddResidualBlock(
      new DistanceResidual(&rows.cache, 0, Vector3d(0, 1, 0), 0.3, 0.1), nullptr, &rows.state[0]);
  double cost = 0;
  EXPECT_TRUE(problem.Evaluate({}, &cost, nullptr, nullptr, nullptr));
  rows.state[0] = std::acos(0.0);  // the arm's end on the anchor
  EXPECT_FALSE(problem.Evaluate({}, &cost, nullptr, nullptr, nullptr));
}

}  // namespace
}  // namespace dhcal
