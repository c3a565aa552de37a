#include "core/report/text_layout.h"

#include <string>

#include <gtest/gtest.h>

namespace dhcal {
namespace {

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

TEST(Wrap, KeepsANumberAndItsUncertaintyOnOneLine) {
  const std::string before(90, 'x');
  EXPECT_EQ(Wrap("", before + " 0.912 +- 0.087 mrad"), before + "\n0.912 +- 0.087 mrad\n");
}

}  // namespace
}  // namespace dhcal
