#include "core/math/statistics.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"

namespace dhcal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Table values: NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7, with more digits from the
// closed forms where there are any.

TEST(StudentTwoSided, WithOneDegreeOfFreedomIsCauchys) {
  EXPECT_NEAR(StudentTwoSided(0.95, 1), std::tan(0.475 * kPi), 1e-11);  // 12.706
}

TEST(StudentTwoSided, WithTwoDegreesOfFreedomHasAClosedForm) {
  // P(|t| <= x) = x / sqrt(2 + x^2).
  EXPECT_NEAR(StudentTwoSided(0.95, 2), 0.95 * std::sqrt(2.0 / (1 - 0.95 * 0.95)), 1e-12);
}

TEST(StudentTwoSided, AgreesWithTheTable) {
  EXPECT_NEAR(StudentTwoSided(0.95, 10), 2.228, 5e-4);
  EXPECT_NEAR(StudentTwoSided(0.99, 30), 2.750, 5e-4);
  EXPECT_NEAR(StudentTwoSided(0.90, 5), 2.015, 5e-4);
}

TEST(StudentTwoSided, WithInfiniteFreedomIsTheNormals) {
  EXPECT_NEAR(StudentTwoSided(0.95, kInfinity), 1.959963984540054, 1e-14);
  EXPECT_NEAR(StudentTwoSided(std::erf(1 / std::sqrt(2.0)), kInfinity), 1.0, 1e-14);
  EXPECT_NEAR(StudentTwoSided(0.95, 1e7), StudentTwoSided(0.95, kInfinity), 1e-6);
}

TEST(ChiSquareTail, WithTwoDegreesOfFreedomIsAnExponential) {
  for (const double x : {0.0, 0.5, 4.0, 60.0, 600.0}) {
    EXPECT_NEAR(ChiSquareTail(x, 2) / std::exp(-x / 2), 1.0, 1e-12) << x;
  }
}

TEST(ChiSquareTail, WithOneDegreeOfFreedomIsTheNormalsTwoTails) {
  for (const double z : {0.1, 1.0, 1.959963984540054, 8.0}) {
    EXPECT_NEAR(ChiSquareTail(z * z, 1) / std::erfc(z / std::sqrt(2.0)), 1.0, 1e-12) << z;
  }
}

TEST(ChiSquareTail, AgreesWithTheTable) {
  EXPECT_NEAR(ChiSquareTail(18.307, 10), 0.05, 5e-6);
  EXPECT_NEAR(ChiSquareTail(124.342, 100), 0.05, 5e-6);
}

TEST(RemovalTail, OfAllSquaresIsNearZeroAndFinite) {
  for (const double left : {0.0, 1e-300, 1e-12, -1e-9}) {
    const double p = RemovalTail(5e5 - left, 1, 5e5, 1322);
    EXPECT_GE(p, 0) << left;
    EXPECT_LT(p, 1e-300) << left;
  }
}

TEST(Tails, OfInfiniteStatisticsAreZeroAndOfNoNumberOne) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(FTail(kInfinity, 3, 100), 0);
  EXPECT_EQ(FTail(-kInfinity, 3, 100), 1);
  EXPECT_EQ(FTail(nan, 3, 100), 1);
  EXPECT_EQ(FTail(2, 0, 100), 1);
  EXPECT_EQ(FTail(2, 3, 0), 1);
  EXPECT_NEAR(FTail(2, 3, kInfinity), ChiSquareTail(6, 3), 1e-12);
  EXPECT_EQ(ChiSquareTail(kInfinity, 3), 0);
  EXPECT_EQ(ChiSquareTail(nan, 3), 1);
  EXPECT_EQ(ChiSquareTail(1, 0), 1);
  EXPECT_EQ(RemovalTail(kInfinity, 3, kInfinity, 100), 1) << "infinity of infinity is no number";
  EXPECT_EQ(RemovalTail(nan, 3, 10, 100), 1);
}

TEST(Scores, OfInfiniteStatisticsAreHighAndOfNoNumberTheLowest) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(FScore(kInfinity, 3, 100), FScore(1e6, 3, 100));
  EXPECT_TRUE(std::isfinite(FScore(kInfinity, 3, 100)));
  EXPECT_GT(ChiSquareScore(kInfinity, 3), 1e6);
  EXPECT_TRUE(std::isfinite(ChiSquareScore(kInfinity, 3)));
  EXPECT_EQ(FScore(nan, 3, 100), FScore(0, 3, 100));
  EXPECT_EQ(ChiSquareScore(nan, 3), ChiSquareScore(0, 3));
}

TEST(RemovalTail, IsTheFTestOfWhatColumnsRemove) {
  // Two columns take 30 of 100 squares, 18 freedoms keep the rest: F = 15 / (70 / 18).
  EXPECT_DOUBLE_EQ(RemovalTail(30, 2, 100, 20), FTail(15.0 / (70.0 / 18), 2, 18));
  EXPECT_EQ(RemovalTail(30, 2, 100, 2.5), 1) << "nothing is left to judge by";
  EXPECT_EQ(RemovalTail(30, 0, 100, 20), 1) << "no column";
  EXPECT_EQ(RemovalTail(30, 2, 100, 20, /*sigma_known=*/true), ChiSquareTail(30, 2));
}

TEST(ChiSquareScore, HasTheTailOfTheNormalAtTheTablesQuantiles) {
  // 95 % quantiles; the cube root is good to a few thousandths there.
  EXPECT_NEAR(ChiSquareScore(18.307 / 10, 10), 1.6449, 0.01);
  EXPECT_NEAR(ChiSquareScore(124.342 / 100, 100), 1.6449, 0.002);
}

TEST(FScore, HasTheTailOfTheNormalAtTheTablesQuantiles) {
  EXPECT_NEAR(FScore(2.3551, 8, 24), 1.6449, 0.005);
  EXPECT_NEAR(FScore(2.9782, 10, 10), 1.6449, 0.005);
  EXPECT_NEAR(FScore(1.8307, 10, 1e9), ChiSquareScore(1.8307, 10), 1e-6);
}

TEST(Median, IsTheMiddleOrBetweenTheMiddleTwo) {
  EXPECT_EQ(Median({3}), 3);
  EXPECT_EQ(Median({5, 1, 3}), 3);
  EXPECT_EQ(Median({10, 1, 2, 4}), 3);
  EXPECT_EQ(Median({-1, -1, -1, 7}), -1);
}

TEST(Median, OfNothingIsNotANumber) { EXPECT_TRUE(std::isnan(Median({}))); }

TEST(RobustScale, IsTheMedianAbsoluteValueScaledToANormal) {
  EXPECT_DOUBLE_EQ(RobustScale({-1, 2, -3}), 1.4826 * 2);
  EXPECT_TRUE(std::isnan(RobustScale({})));
}

TEST(RobustScale, FindsSigmaInSpiteOfOutliers) {
  Rng rng(1);
  std::vector<double> values;
  for (int i = 0; i < 20000; ++i) values.push_back(0.02 * rng.Normal());
  // The median absolute value of N normals scatters by 1.17 / sqrt(N) = 0.8 %.
  EXPECT_NEAR(RobustScale(values), 0.02, 0.02 * 0.03);
  for (std::size_t i = 0; i < 200; ++i) values[i] = 1e6;
  EXPECT_NEAR(RobustScale(values), 0.02, 0.02 * 0.05);
}

TEST(Statistics, LogarithmsOfTailsContinueWhereTailsEnd) {
  for (const double dof : {1.0, 2.0, 3.0, 12.0}) {
    EXPECT_NEAR(LogChiSquareTail(20, dof), std::log(ChiSquareTail(20, dof)), 1e-9);
    // Across the switch at 1e-290 the slope stays that of exp(-x/2).
    const double below = LogChiSquareTail(1200, dof), above = LogChiSquareTail(1500, dof);
    EXPECT_NEAR(above - below, -150 + (dof / 2 - 1) * std::log(1500.0 / 1200), 0.01) << dof;
  }
  EXPECT_NEAR(LogChiSquareTail(4000, 2), -2000, 1e-6) << "exactly exp(-x/2)";
  // With two columns the F tail is (1 + 2 x / nu)^(-nu / 2) exactly.
  EXPECT_NEAR(LogFTail(1e4, 2, 300), -150 * std::log1p(2e4 / 300), 1e-6);
  EXPECT_NEAR(LogFTail(1e9, 2, 300), -150 * std::log1p(2e9 / 300), 1e-3);
  EXPECT_EQ(LogChiSquareTail(0, 3), 0);
}

}  // namespace
}  // namespace dhcal
