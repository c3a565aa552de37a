#include "core/report/summary_table.h"

#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/text.h"
#include "core/report/text_table.h"
#include "tests/support/example_result.h"

namespace dhcal {
namespace {

using testing::ContainsRegex;

TEST(SummaryTable, HasOneLinePerProblem) {
  const Result good = ExampleResult();
  const Result diverged = DivergedResult();
  const std::string table = ToText(SummaryTable({{"kr15", "ok", &good},
                                                 {"broken", "input error", nullptr},
                                                 {"wild", "diverged", &diverged}}));
  EXPECT_THAT(table, ContainsRegex("problem +rows +rank +solver +steps +RMS before"));
  EXPECT_THAT(table, ContainsRegex("kr15 +10 +21/23 +SVD-GN +3 +0.7100 +0.03530 +0.03464 +ok\n"));
  EXPECT_THAT(table, ContainsRegex("broken +- +- +- +- +- +- +- +input error\n"));
  EXPECT_THAT(table, ContainsRegex("wild +10 +24/24 +SVD-GN +20 +2.600 +- +0.03464 +diverged\n"));
}

TEST(SummaryTable, StaysWithinAHundredColumns) {
  Result wide = ExampleResult();
  wide.rows = 123456789;
  wide.fits[0].rank = wide.fits[0].columns = 12345;
  wide.fits[0].iterations = 100000;
  wide.noise_sigma = wide.fits[0].rms_point = 1.23456e199;
  const std::string table =
      ToText(SummaryTable({{std::string(200, 'p'), std::string(90, 's'), &wide}}));
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(CountCharacters(line), 100) << line;
}

TEST(SummaryTable, OfNothingIsItsHeading) {
  EXPECT_THAT(ToText(SummaryTable({})), testing::StartsWith("  problem"));
}

}  // namespace
}  // namespace dhcal
