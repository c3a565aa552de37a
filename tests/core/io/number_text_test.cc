#include "core/io/number_text.h"

#include <gtest/gtest.h>

namespace dhcal {
namespace {

TEST(NumberText, DecimalMarkDecides) {
  EXPECT_EQ(PlainNumber("-0,5", ','), "-0.5");
  EXPECT_FALSE(FormOf("-0,5", '.'));
  EXPECT_EQ(PlainNumber("1,234", ','), "1.234");
  EXPECT_EQ(PlainNumber("1,234", '.'), "1234");
  EXPECT_TRUE(IsOpen(FormOf("1,234", '.'), FormOf("1,234", ',')));
  EXPECT_TRUE(IsOpen(FormOf("1.234", '.'), FormOf("1.234", ',')));
  EXPECT_FALSE(IsOpen(FormOf("1234", '.'), FormOf("1234", ',')));
  EXPECT_FALSE(IsOpen(FormOf("1 234", '.'), FormOf("1 234", ',')));
}

TEST(NumberText, ThousandsAreGroupsOfThreeOfOneKind) {
  EXPECT_EQ(PlainNumber("2,392.6452", '.'), "2392.6452");
  EXPECT_EQ(PlainNumber("2.392,6452", ','), "2392.6452");
  EXPECT_EQ(PlainNumber("1\xE2\x80\xAF"
                        "234\xE2\x80\xAF"
                        "567,8",
                        ','),
            "1234567.8");
  EXPECT_EQ(PlainNumber("1'234.5", '.'), "1234.5");
  for (const char* const text :
       {"12,34", "1234,567", "0,123", "1,2345", "1,234,56", "1.234,567.8"}) {
    EXPECT_FALSE(FormOf(text, '.')) << text;
  }
}

TEST(NumberText, SignsAndExponents) {
  EXPECT_EQ(PlainNumber("\xE2\x88\x92"
                        "1,5E\xE2\x88\x92"
                        "3",
                        ','),
            "-1.5e-3");
  EXPECT_EQ(PlainNumber("2,02011E+13", ','), "2.02011e13");
  EXPECT_EQ(PlainNumber("+.5", '.'), ".5");
  for (const char* const text :
       {"", "-", "+", ".", ",", "e5", "1e", "--1", "1-2", "0x10", "1 2", "inf"}) {
    EXPECT_FALSE(IsNumberText(text)) << text;
  }
}

TEST(NumberText, BlankWords) {
  for (const char* const text :
       {"NaN", "nan", "N/A", "#N/A", "#WERT!", "#VALUE!", "-", "--", "NULL"}) {
    EXPECT_TRUE(IsBlankWord(text)) << text;
  }
  for (const char* const text : {"", "0", "-1", "inf", "A", "banana"}) {
    EXPECT_FALSE(IsBlankWord(text)) << text;
  }
}

}  // namespace
}  // namespace dhcal
