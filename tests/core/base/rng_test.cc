#include "core/base/rng.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>

#include <gtest/gtest.h>

namespace dhcal {
namespace {

static_assert(!std::is_copy_constructible_v<Rng>, "a copy would repeat the same numbers");
static_assert(!std::is_copy_assignable_v<Rng>, "a copy would repeat the same numbers");

TEST(Rng, UniformIsTheMersenneTwistersNumberOverItsRange) {
  Rng rng(2024);
  std::mt19937_64 twister(2024);  // specified to the bit by the standard
  for (int i = 0; i < 1000; ++i) {
    const double expected = std::ldexp(static_cast<double>(twister()), -64);
    EXPECT_NEAR(rng.Uniform(0, 1), expected, 1e-15) << "number " << i;
  }
}

TEST(Rng, NormalGivesTheNumbersItAlwaysGave) {
  // Taken from the program itself: simulated recordings and reported results depend on them, so a
  // library that changes them must be noticed.
  Rng rng(1);
  for (const double expected :
       {-0.22770229850701265, -0.25937725029558445, -0.61281862908331552, -0.030246828233049857}) {
    EXPECT_DOUBLE_EQ(rng.Normal(), expected);
  }
}

TEST(Rng, SameSeedGivesTheSameNumbersAndAnotherDoesNot) {
  Rng a(7), b(7), c(8);
  for (int i = 0; i < 100; ++i) {
    const double number = a.Normal();
    EXPECT_EQ(number, b.Normal());
    EXPECT_NE(number, c.Normal());
  }
}

TEST(Rng, UniformStaysInItsInterval) {
  Rng rng(3);
  double low = 1, high = -1;
  for (int i = 0; i < 100000; ++i) {
    const double number = rng.Uniform(-0.25, 0.75);
    low = std::min(low, number);
    high = std::max(high, number);
  }
  EXPECT_GE(low, -0.25);
  EXPECT_LT(high, 0.75);
  EXPECT_LT(low, -0.2499);
  EXPECT_GT(high, 0.7499);
}

TEST(Rng, NormalHasMeanZeroVarianceOneAndNormalTails) {
  Rng rng(4);
  constexpr int kCount = 100000;
  double sum = 0, squares = 0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double number = rng.Normal();
    sum += number;
    squares += number * number;
    if (std::abs(number) > 2) ++beyond_two;
  }
  // Four standard deviations: of the mean 1/sqrt(N), of the variance sqrt(2/N), of the count
  // sqrt(N p (1 - p)) with p = 0.0455.
  EXPECT_NEAR(sum / kCount, 0.0, 4 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0, 4 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(beyond_two, 0.0455 * kCount, 4 * std::sqrt(kCount * 0.0455 * 0.9545));
}

}  // namespace
}  // namespace dhcal
