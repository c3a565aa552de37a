#include "residuals/adjacent_position.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/residuals/cached_rows.h"

namespace dhcal {
namespace {

using Eigen::Vector3d;

/// Two series, one per run of CachedRows, with sigmas that differ from row to row.
RunningMeans TwoSeries(int num_rows) {
  std::vector<int> previous;
  Eigen::VectorXd sigma(num_rows);
  for (int row_idx = 0; row_idx < num_rows; ++row_idx) {
    previous.push_back(row_idx - 2 < 0 ? -1 : row_idx - 2);
    sigma[row_idx] = 0.3 + 0.1 * row_idx;
  }
  return {previous, sigma};
}

TEST(AdjacentPositionResidual, IsPredictedMinusMeasuredDisplacementOverSigma) {
  const OneArmRows rows({0.0, kPi / 2});  // from (1, 0, 0) to (0, 1, 0)
  const AdjacentPositionResidual block(&rows.cache, 0, 1, Vector3d(-1.2, 0.9, 0.4), 0.2);
  const BlockValues values = Evaluate(block);
  ASSERT_TRUE(values.valid);
  EXPECT_THAT(values.r, MatrixNear(Vector3d(1, 0.5, -2), 1e-14));
  EXPECT_THAT(values.J, MatrixNear(Vector3d(-5, -5, 0), 1e-14));  // (-1, 0) - (0, 1) over 0.2
}

TEST(AdjacentPositionResidual, IsZeroWhereTheReadingWasTaken) {
  Rng rng(1);
  CachedRows rows(Ur10(), 3, &rng);
  rows.MoveTo(rows.state_vector(), false);
  const Vector3d displacement = rows.cache.p_WQ(2) - rows.cache.p_WQ(0);
  const AdjacentPositionResidual block(&rows.cache, 0, 2, displacement, 1e-5);
  EXPECT_EQ(Evaluate(block, false).r, Vector3d::Zero());
}

TEST(AdjacentPositionResidual, DerivativesAreRiddersDifferences) {
  for (const TestRobot& robot : TestRobots()) {
    SCOPED_TRACE(robot.model.name);
    Rng rng(2);
    CachedRows rows(robot.model, 4, &rng);
    const AdjacentPositionResidual block(&rows.cache, 1, 3, Vector3d(0.2, 0.1, -0.4), 0.5);
    ExpectRiddersDerivatives(block, 3, &rows, &rng);
  }
}

TEST(SharedAdjacentPositionResidual, ComparesWithTheMeanOfAllEarlierPoses) {
  OneArmRows rows({0.0, kPi / 2, kPi});  // (1, 0, 0), (0, 1, 0), (-1, 0, 0)
  rows.cache.EnableRunningMeans(RunningMeans({-1, 0, 1}, Vector3d::Constant(0.2)));
  rows.state[0] = 1.0;  // away and back: the means are filled when the poses are computed
  rows.cache.PrepareForEvaluation(true, true);
  rows.state[0] = 0.0;
  rows.cache.PrepareForEvaluation(true, true);
  // The third minus the mean of two is (-1.5, -0.5, 0), with variance 0.04 (1 + 1/2).
  const SharedAdjacentPositionResidual block(&rows.cache, 2, Vector3d(-1.5, -0.8, 0.3));
  const double sigma = std::sqrt(0.06);
  const BlockValues values = Evaluate(block);
  ASSERT_TRUE(values.valid);
  EXPECT_THAT(values.r, MatrixNear(Vector3d(0, 0.3, -0.3) / sigma, 1e-14));
  // Turning by theta moves them by (0, 1), (-1, 0), (0, -1).
  EXPECT_THAT(values.J, MatrixNear(Vector3d(0.5, -1.5, 0) / sigma, 1e-14));
}

TEST(SharedAdjacentPositionResidual, DerivativesAreRiddersDifferences) {
  for (const TestRobot& robot : TestRobots()) {
    SCOPED_TRACE(robot.model.name);
    Rng rng(3);
    CachedRows rows(robot.model, 8, &rng);
    rows.cache.EnableRunningMeans(TwoSeries(8));
    for (const int row_idx : {2, 7}) {
      const SharedAdjacentPositionResidual block(&rows.cache, row_idx, Vector3d(0.2, 0.1, -0.4));
      ExpectRiddersDerivatives(block, row_idx, &rows, &rng);
    }
  }
}

}  // namespace
}  // namespace dhcal
