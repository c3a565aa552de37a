#include "core/report/format.h"

#include <limits>

#include <gtest/gtest.h>

namespace dhcal {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Fixed, PrintsNeitherNegativeZeroNorNaN) {
  EXPECT_EQ(Fixed(-1e-9, 3), "0.000");
  EXPECT_EQ(Fixed(-0.0, 0), "0");
  EXPECT_EQ(Fixed(kNaN, 3), "-");
  EXPECT_EQ(Fixed(-0.0005001, 3), "-0.001");
}

TEST(Fixed, IsScientificWhereFixedWouldBeEndless) {
  EXPECT_EQ(Fixed(1e300, 3), "1.000e+300");
  EXPECT_EQ(Fixed(-kInf, 3), "-inf");
}

TEST(FixedWithin, GivesUpDecimalsBeforeDigits) {
  EXPECT_EQ(FixedWithin(-179.950151, 6, 10), "-179.95015");
  EXPECT_EQ(FixedWithin(123456.789, 3, 6), "123457");
  EXPECT_EQ(FixedWithin(-1234567.0, 3, 7), "-1e+06");
}

TEST(Millimetres, ShowsFourDigitsAtAnySize) {
  EXPECT_EQ(Millimetres(2.0399e-5), "0.02040");
  EXPECT_EQ(Millimetres(0.99996e-3), "1.000");
  EXPECT_EQ(Millimetres(70.123), "70123");
  EXPECT_EQ(Millimetres(2.1e-16), "<0.0001");
  EXPECT_EQ(Millimetres(0), "0");
}

TEST(DecimalsOf, ShowsTwoDigitsOfTheUncertainty) {
  EXPECT_EQ(DecimalsOf(0.013, 9), 3);
  EXPECT_EQ(DecimalsOf(1.3, 9), 1);
  EXPECT_EQ(DecimalsOf(310, 9), 0);
  EXPECT_EQ(DecimalsOf(0.0996, 9), 2);  // prints as 0.10
  EXPECT_EQ(DecimalsOf(0, 9), 9);
  EXPECT_EQ(DecimalsOf(kNaN, 9), 9);
}

}  // namespace
}  // namespace dhcal
