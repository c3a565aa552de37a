// The search over sets, on small Gram matrices built so that steps of one item fail.
#include "problems/diagnosis/search/beam.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_matrix.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Setting {
  MatrixXd C;
  VectorXd y;
  std::vector<GramItem> items;

  SetEvaluator Evaluator() const {
    EvidenceRule rule;
    rule.sigma_known = true;
    rule.dof = static_cast<double>(y.size());
    rule.poses = static_cast<double>(y.size()) / 3;
    rule.names = 20;
    return SetEvaluator({C.transpose() * C,
                         C.transpose() * y,
                         C.colwise().squaredNorm().transpose(),
                         y.squaredNorm()},
                        items,
                        rule);
  }
};

/// Unit-length columns of random directions, `extra` after them.
Setting RandomSetting(int columns, std::uint64_t seed) {
  Rng rng(seed);
  Setting s;
  s.C = RandomMatrix(300, columns, &rng);
  s.y = RandomMatrix(300, 1, &rng);
  for (int k = 0; k < columns; ++k) {
    GramItem item;
    item.id = std::to_string(k);
    item.first = k;
    item.size = 1;
    item.positive = {false};
    s.items.push_back(item);
  }
  return s;
}

TEST(SearchSets, FindsNothingInNoise) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SetEvaluator evaluator = RandomSetting(20, seed).Evaluator();
    EXPECT_TRUE(SearchSets({}, &evaluator).best.empty()) << seed;
  }
}

TEST(SearchSets, FindsTwoCausesThatASingleImitatesBest) {
  // Column 0 lies between 1 and 2: alone it removes most, and beside it neither of the two pays.
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Setting s = RandomSetting(12, seed);
    s.C.col(0) = s.C.col(1) + s.C.col(2) + 0.15 * s.C.col(0);
    s.y += 2.0 * (s.C.col(1) + s.C.col(2)) + 1e-9 * s.C.col(0);
    SetEvaluator evaluator = s.Evaluator();
    ASSERT_GT(evaluator.Evaluate({1}).evidence, evaluator.Evaluate({0}).evidence);
    EXPECT_EQ(SearchSets({}, &evaluator).best, (ItemSet{1, 2})) << seed;
  }
}

TEST(SearchSets, LeavesAWrongStart) {
  Setting s = RandomSetting(12, 3);
  s.y += 1.5 * s.C.col(4) + s.C.col(7) + 0.8 * s.C.col(9);
  SetEvaluator evaluator = s.Evaluator();
  EXPECT_EQ(SearchSets({{0, 1, 2, 3}}, &evaluator).best, (ItemSet{4, 7, 9}));
}

TEST(NotToldApart, ListsWhatDoesAsWellOnceAndMinimal) {
  Setting s = RandomSetting(12, 5);
  s.C.col(1) = s.C.col(0) + 0.01 * s.C.col(1);  // does nearly all that column 0 does
  s.y += 1.0 * s.C.col(0);
  s.items[3].id = s.items[2].id;
  SetEvaluator evaluator = s.Evaluator();
  const BeamOutcome outcome = SearchSets({}, &evaluator);
  const std::vector<ItemSet> listed = NotToldApart(outcome, outcome.best, 10, &evaluator);
  ASSERT_EQ(listed.size(), 2);
  EXPECT_EQ(listed[0].size(), 1);
  EXPECT_EQ(listed[1].size(), 1);
  EXPECT_EQ(std::min(listed[0][0], listed[1][0]), 0);
  EXPECT_EQ(std::max(listed[0][0], listed[1][0]), 1);
}

/// Columns 1 to 4 are one item that holds nearly all of column 0, the cause; of one class or not.
std::vector<ItemSet> ListedBesideALargerName(const std::string& taken_for) {
  Setting s = RandomSetting(12, 7);
  s.C.col(1) = s.C.col(0) + 0.01 * s.C.col(1);
  s.y += 1.0 * s.C.col(0);
  s.items.erase(s.items.begin() + 2, s.items.begin() + 5);
  s.items[1].size = 4;
  s.items[1].positive.assign(4, false);
  s.items[0].taken_for = "C5";
  s.items[1].taken_for = taken_for;
  SetEvaluator evaluator = s.Evaluator();
  return NotToldApart(SearchSets({}, &evaluator), {0}, 10, &evaluator);
}

TEST(NotToldApart, ListsANameOfTheSameClassThatHasMoreParameters) {
  EXPECT_EQ(ListedBesideALargerName("C5"), (std::vector<ItemSet>{{0}, {1}}));
  EXPECT_EQ(ListedBesideALargerName("C6"), (std::vector<ItemSet>{{0}}));
}

TEST(NotToldApart, OneClearCauseStandsAlone) {
  Setting s = RandomSetting(12, 6);
  s.y += 1.0 * s.C.col(5);
  SetEvaluator evaluator = s.Evaluator();
  const BeamOutcome outcome = SearchSets({}, &evaluator);
  EXPECT_EQ(NotToldApart(outcome, outcome.best, 10, &evaluator), (std::vector<ItemSet>{{5}}));
}

}  // namespace
}  // namespace dhcal
