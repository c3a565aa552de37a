#include "core/base/text.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dhcal {
namespace {

TEST(ParseDouble, ReadsWholeNumbersAndDecimals) {
  EXPECT_EQ(ParseDouble("0"), 0.0);
  EXPECT_EQ(ParseDouble("-12.5"), -12.5);
  EXPECT_EQ(ParseDouble("+3"), 3.0);
  EXPECT_EQ(ParseDouble(".5"), 0.5);
  EXPECT_EQ(ParseDouble("5."), 5.0);
  EXPECT_EQ(ParseDouble("-2e-3"), -0.002);
  EXPECT_EQ(ParseDouble("1E6"), 1e6);
}

TEST(ParseDouble, ReadsTheNearestDouble) {
  EXPECT_EQ(ParseDouble("0.1"), 0.1);
  EXPECT_EQ(ParseDouble("1.7976931348623157e308"), std::numeric_limits<double>::max());
}

TEST(ParseDouble, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"",
                           " ",
                           "abc",
                           "1 ",
                           " 1",
                           "1,5",
                           "0x10",
                           "1e",
                           "--1",
                           "+-1",
                           "++1",
                           "nan",
                           "inf",
                           "-inf",
                           "infinity",
                           "1e999",
                           "1.5.2",
                           "1_000",
                           "+"}) {
    EXPECT_EQ(ParseDouble(text), std::nullopt) << text;
  }
}

TEST(ParseInteger, RefusesFractionsAndOverflow) {
  EXPECT_EQ(ParseInteger("-7"), -7);
  EXPECT_EQ(ParseInteger("1.0"), std::nullopt);
  EXPECT_EQ(ParseInteger("9223372036854775808"), std::nullopt);
}

TEST(ParseUnsigned, ReadsTheLargestAndRefusesNegatives) {
  EXPECT_EQ(ParseUnsigned("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(ParseUnsigned("-1"), std::nullopt);
}

TEST(Trim, TakesBlanksAndTabsOff) {
  EXPECT_EQ(Trim(" \t a b\t"), "a b");
  EXPECT_EQ(Trim("  "), "");
  EXPECT_EQ(Trim(""), "");
}

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(EditDistance("kappa", "kappa"), 0);
  EXPECT_EQ(EditDistance("kapa", "kappa"), 1);
  EXPECT_EQ(EditDistance("kappaa", "kappa"), 1);
  EXPECT_EQ(EditDistance("kabpa", "kappa"), 1);
  EXPECT_EQ(EditDistance("kpapa", "kappa"), 1);
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("abc", ""), 3);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
}

TEST(EditDistance, IgnoresCase) { EXPECT_EQ(EditDistance("Theta_DEG", "theta_deg"), 0); }

TEST(NearestName, FindsTypingErrorsAndForgottenUnits) {
  EXPECT_EQ(NearestName("kapa", {"method", "kappa"}), "kappa");
  EXPECT_EQ(NearestName("xyz", {"rpy_deg", "xyz_m", "xyz_mm"}), "xyz_m");
  EXPECT_EQ(NearestName("THETA1", {"theta1", "theta2"}), "theta1");
}

TEST(NearestName, NamesNothingThatIsFarAway) {
  EXPECT_EQ(NearestName("speed", {"kappa", "method"}), "");
  EXPECT_EQ(NearestName("b", {"alpha"}), "");
  EXPECT_EQ(NearestName("", {"a"}), "");
  EXPECT_EQ(NearestName("a", {}), "");
}

TEST(QuotedList, JoinsWithCommasAndOneWord) {
  EXPECT_EQ(QuotedList({"a"}), "'a'");
  EXPECT_EQ(QuotedList({"a", "b"}), "'a' or 'b'");
  EXPECT_EQ(QuotedList({"a", "b", "c"}, "and"), "'a', 'b' and 'c'");
}

TEST(CountCharacters, CountsCodePointsNotBytes) {
  EXPECT_EQ(CountCharacters("Müller"), 6);
  EXPECT_EQ(CountCharacters("€ 𝛉"), 3);
}

TEST(FindInvalidUtf8, AcceptsEveryLengthOfCharacter) {
  EXPECT_EQ(FindInvalidUtf8("a é € 𝛉 \xF4\x8F\xBF\xBF"), std::nullopt);
}

TEST(FindInvalidUtf8, FindsWhatIsMalformed) {
  for (const char* bad : {"\x80",              // continuation without a start
                          "\xC0\xAF",          // overlong
                          "\xE0\x80\xAF",      // overlong
                          "\xED\xA0\x80",      // surrogate
                          "\xF4\x90\x80\x80",  // beyond U+10FFFF
                          "\xE2\x82",          // cut off
                          "\xFF"}) {
    EXPECT_EQ(FindInvalidUtf8(std::string("ab") + bad), 2u);
  }
}

TEST(Printable, CutsLongTextsAndHidesControlCharacters) {
  EXPECT_EQ(Printable("a\tb\x1B[31m"), "a?b?[31m");
  EXPECT_EQ(Printable(std::string(100, 'x')), std::string(60, 'x') + "...");
}

}  // namespace
}  // namespace dhcal
