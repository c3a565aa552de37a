// Readings that lie off, at any share of them.
#include "problems/diagnosis/rows/outliers.h"

#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

#include "tests/support/random_matrix.h"

namespace dhcal {
namespace {

ReadingResiduals NoiseOnly(int fitted, int test, std::uint64_t seed) {
  Rng rng(seed);
  ReadingResiduals residuals;
  residuals.fitted = RandomMatrix(3 * fitted, 1, &rng);
  residuals.test = RandomMatrix(3 * test, 1, &rng);
  return residuals;
}

TEST(FindOutliers, NoneInNoise) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    found += FindOutliers(NoiseOnly(300, 60, seed), true).count();
  }
  EXPECT_LE(found, 1);
}

TEST(FindOutliers, AFifthOfBadRowsIsFound) {
  ReadingResiduals residuals = NoiseOnly(300, 50, 1);
  for (int k = 0; k < 55; ++k) residuals.fitted[15 * k + 1] += 12;
  residuals.test[0] = 12;
  const Outliers outliers = FindOutliers(residuals, true);
  for (int k = 0; k < 55; ++k) {
    EXPECT_TRUE(outliers.fitted[static_cast<std::size_t>(5 * k)]) << k;
  }
  EXPECT_TRUE(outliers.test[0]) << "test rows are screened, too";
  EXPECT_EQ(outliers.count(), 56);
}

TEST(FindOutliers, AMisfitWidensTheLimitAndAGoodFitDoesNotNarrowIt) {
  ReadingResiduals wide = NoiseOnly(200, 0, 2);
  wide.fitted *= 5;
  EXPECT_EQ(FindOutliers(wide, true).count(), 0);
  EXPECT_NEAR(FindOutliers(wide, true).scale, 5, 0.5);
  ReadingResiduals narrow = NoiseOnly(200, 0, 2);
  narrow.fitted *= 0.2;
  narrow.fitted[0] = 3;
  EXPECT_FALSE(FindOutliers(narrow, true).fitted[0]) << "within the stated noise";
  EXPECT_TRUE(FindOutliers(narrow, false).fitted[0]);
}

TEST(FindOutliers, AtMostAShareIsSetAside) {
  ReadingResiduals residuals = NoiseOnly(100, 0, 3);
  for (int k = 0; k < 45; ++k) residuals.fitted[3 * k] += 50 + k;
  const Outliers outliers = FindOutliers(residuals, true);
  EXPECT_LE(outliers.count(), 20);
  EXPECT_TRUE(outliers.fitted[44]) << "the worst";
}

TEST(FindOutliers, LeverageCountsForARowThatPullsTheFit) {
  ReadingResiduals residuals = NoiseOnly(100, 0, 4);
  residuals.fitted.segment<3>(30).setConstant(2.2);
  EXPECT_FALSE(FindOutliers(residuals, true).fitted[10]);
  residuals.leverage = Eigen::VectorXd::Zero(100);
  residuals.leverage[10] = 0.6;
  EXPECT_TRUE(FindOutliers(residuals, true).fitted[10]);
}

}  // namespace
}  // namespace dhcal
