// Intervals of rates against published values.

#include "tools/proof/wilson.h"

#include <gtest/gtest.h>

namespace dhcal {
namespace {

TEST(Wilson, IsTheTextbooksInterval) {
  // Agresti and Coull 1998: 0, 5 and 10 of 10.
  EXPECT_NEAR(WilsonInterval(0, 10).low, 0, 1e-12);
  EXPECT_NEAR(WilsonInterval(0, 10).high, 0.2775, 1e-4);
  EXPECT_NEAR(WilsonInterval(5, 10).low, 0.2366, 1e-4);
  EXPECT_NEAR(WilsonInterval(5, 10).high, 0.7634, 1e-4);
  EXPECT_NEAR(WilsonInterval(10, 10).low, 0.7225, 1e-4);
  EXPECT_NEAR(WilsonInterval(10, 10).high, 1, 1e-12);
}

TEST(Wilson, IsMirroredByTheMisses) {
  for (const int hits : {0, 3, 17, 40}) {
    EXPECT_NEAR(WilsonInterval(hits, 40).low, 1 - WilsonInterval(40 - hits, 40).high, 1e-12);
  }
}

TEST(Wilson, SaysNothingWithoutTrials) {
  EXPECT_EQ(WilsonInterval(0, 0).low, 0);
  EXPECT_EQ(WilsonInterval(0, 0).high, 1);
  EXPECT_EQ(RateText(0, 0), "-");
  EXPECT_EQ(RateText(5, 10), "5/10 50 % (24-76)");
}

}  // namespace
}  // namespace dhcal
