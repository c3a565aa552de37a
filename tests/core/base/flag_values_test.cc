#include "core/base/flag_values.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dhcal {
namespace {

using testing::HasSubstr;

TEST(FlagValues, AreTakenWithinTheirRange) {
  Diagnostics diagnostics;
  FlagValues flags(&diagnostics);
  double length = 3;
  int count = 4;
  EXPECT_TRUE(flags.Number("length_mm", "-2.5", -3, 3, &length));
  flags.Whole("count", "7", 1, 10, &count);
  EXPECT_TRUE(diagnostics.ok());
  EXPECT_EQ(length, -2.5);
  EXPECT_EQ(count, 7);
}

TEST(FlagValues, KeepWhatStandsThereWhereTheyAreNotGiven) {
  Diagnostics diagnostics;
  FlagValues flags(&diagnostics);
  double length = 3;
  int count = 4;
  EXPECT_FALSE(flags.Number("length_mm", "", 0, 1, &length));
  flags.Whole("count", "", 0, 1, &count);
  EXPECT_TRUE(diagnostics.ok());
  EXPECT_EQ(length, 3);
  EXPECT_EQ(count, 4);
}

TEST(FlagValues, ThatAreWrongSayWhatIsExpected) {
  for (const char* const text : {"many", "0.5", "11", "nan", "1e400"}) {
    Diagnostics diagnostics;
    FlagValues flags(&diagnostics);
    int count = 4;
    flags.Whole("count", text, 1, 10, &count);
    EXPECT_FALSE(diagnostics.ok()) << text;
    EXPECT_THAT(diagnostics.ToString(), HasSubstr("command line"));
    EXPECT_THAT(diagnostics.ToString(), HasSubstr("--count is '" + std::string(text) + "'"));
    EXPECT_THAT(diagnostics.ToString(), HasSubstr("a number from 1 to 10 is expected"));
    EXPECT_EQ(count, 4);
  }
  Diagnostics diagnostics;
  FlagValues flags(&diagnostics);
  int count = 4;
  flags.Whole("count", "2.5", 1, 10, &count);
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("a whole number is expected"));
  EXPECT_EQ(count, 4);
}

}  // namespace
}  // namespace dhcal
