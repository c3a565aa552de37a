#include "core/report/format.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/text_table.h"

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
  EXPECT_EQ(Millimetres(2.1e-16), "2.10e-13");
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

TEST(Clip, KeepsBothEnds) {
  EXPECT_EQ(Clip("abcdefghij", 10), "abcdefghij");
  EXPECT_EQ(Clip("abcdefghijk", 8), "abc..ijk");
  EXPECT_EQ(Clip("\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc", 5), "\u00e4\u00f6..\u00fc");
}

TEST(Wrap, IndentsTheFollowingLinesAndBreaksEndlessWords) {
  const std::string text = Wrap("  - ", "short " + std::string(200, 'w'));
  EXPECT_EQ(text,
            "  - short\n    " + std::string(96, 'w') + "\n    " + std::string(96, 'w') + "\n    " +
                std::string(8, 'w') + "\n");
  EXPECT_EQ(Wrap("  label ", ""), "  label\n");
}

TEST(TextTable, AlignsDecimalPointsAndShortensTheFirstColumn) {
  TextTable table({{"name", "", 200, TextTable::Align::kLeft},
                   {"value", "[mm]", 12, TextTable::Align::kPoint}});
  table.AddRow({"a", "-1.25"});
  table.AddRow({"b", "10"});
  table.AddRow({"c", "1.3e-09"});
  table.AddLine("across");
  EXPECT_EQ(table.ToString(),
            "  name    value\n"
            "           [mm]\n"
            "  a       -1.25\n"
            "  b       10\n"
            "  c     1.3e-09\n"
            "  across\n");

  TextTable wide({{"name", "", 200, TextTable::Align::kLeft}, {"value", ""}});
  wide.AddRow({std::string(150, 'n'), "1"});
  const std::string text = wide.ToString();
  EXPECT_THAT(text, testing::HasSubstr("nn..nn"));
  EXPECT_EQ(text.size() - text.find('\n') - 2, 100u);
}

}  // namespace
}  // namespace dhcal
