#include "core/io/angle_text.h"

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace dhcal {
namespace {

TEST(AngleText, PiWithFactorsAndDivisors) {
  EXPECT_DOUBLE_EQ(ParsePi("pi").value(), kPi);
  EXPECT_DOUBLE_EQ(ParsePi("-pi/2").value(), -kPi / 2);
  EXPECT_DOUBLE_EQ(ParsePi("3*pi/4").value(), 3 * kPi / 4);
  EXPECT_DOUBLE_EQ(ParsePi("3pi / 4").value(), 3 * kPi / 4);
  EXPECT_DOUBLE_EQ(ParsePi("+0.5*pi").value(), kPi / 2);
  EXPECT_DOUBLE_EQ(ParsePi("pi*2").value(), 2 * kPi);
  EXPECT_DOUBLE_EQ(ParsePi("pi/2 rad").value(), kPi / 2);
}

TEST(AngleText, OtherTextsAreNone) {
  for (const char* const text : {"", "1.5", "pie", "pi/0", "pi/", "*pi", "pi+1", "2/pi", "pi pi"}) {
    EXPECT_FALSE(ParsePi(text)) << text;
  }
}

}  // namespace
}  // namespace dhcal
