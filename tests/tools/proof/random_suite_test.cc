// A part of the random group as a user runs it: twelve seeds that were chosen before they were run.

#include "tools/proof/random_suite.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "tools/proof/random_rates.h"
#include "tools/proof/random_table.h"

namespace dhcal {
namespace {

constexpr double kChance = 1e-3;  // that a program at its bar fails here by bad luck

/// Most events among `trials` of probability `rate`, but for kChance.
int MostByChance(int trials, double rate) {
  double below = 0, term = std::pow(1 - rate, trials);
  for (int k = 0; k < trials; ++k) {
    below += term;
    if (below > 1 - kChance) return k;
    term *= rate / (1 - rate) * (trials - k) / (k + 1);
  }
  return trials;
}

TEST(MostByChance, IsTheBinomialQuantile) {
  // 12 trials at 1 %: P(0) = 0.8864, P(1) = 0.1074, P(2) = 0.0060, beyond 0.0002.
  EXPECT_EQ(MostByChance(12, 0.01), 2);
  EXPECT_EQ(MostByChance(12, 0), 0);
}

TEST(RandomSuite, TwelveSeedsKeepTheBars) {
  const TempFolder folder;
  ProofOptions options;
  options.folder = folder.path();
  options.program = DHCAL_PROGRAM;
  options.random = kSanitized ? 1 : 12;
  options.first = 1;
  const std::vector<RandomScore> scores = RunRandomProof(options, [](int /*done*/, int /*all*/) {});
  ASSERT_EQ(static_cast<int>(scores.size()), options.random);
  for (const RandomScore& score : scores) {
    EXPECT_EQ(score.failure, "") << score.name;
    for (const std::string& sentence : score.contradictions) {
      ADD_FAILURE() << score.name << " contradicts itself: " << sentence;
    }
  }
  for (const RandomRate& rate : RandomRates(scores)) {
    const int bad = rate.at_most ? rate.hits : rate.trials - rate.hits;
    const double bar = rate.at_most ? rate.bar : 1 - rate.bar;
    EXPECT_LE(bad, MostByChance(rate.trials, bar)) << rate.title << "\n" << RandomTable(scores);
  }
}

TEST(RandomSuite, RunsAloneUnlessScenariosAreNamed) {
  ProofOptions options;
  options.random = 3;
  EXPECT_TRUE(CasesOf(options).empty());
  options.only = {"D4"};
  options.seeds = 2;
  EXPECT_EQ(CasesOf(options).size(), 2);
}

}  // namespace
}  // namespace dhcal
