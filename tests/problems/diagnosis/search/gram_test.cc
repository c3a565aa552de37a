// Sets of items on small Gram matrices whose least squares are known.
#include "problems/diagnosis/search/gram.h"

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include "problems/diagnosis/tuning.h"
#include "tests/support/random_matrix.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

GramItem OneColumn(const std::string& id, int column, bool positive = false) {
  GramItem item;
  item.id = id;
  item.first = column;
  item.size = 1;
  item.positive = {positive};
  return item;
}

Gram GramOfRows(const MatrixXd& C, const VectorXd& y) {
  return {
      C.transpose() * C, C.transpose() * y, C.colwise().squaredNorm().transpose(), y.squaredNorm()};
}

EvidenceRule KnownSigma(double dof) {
  EvidenceRule rule;
  rule.sigma_known = true;
  rule.dof = dof;
  rule.poses = dof;
  rule.names = 10;
  return rule;
}

TEST(EvidenceRule, CountsSquaresUpToTheNoiseAndTheirLogarithmBeyond) {
  const EvidenceRule rule = KnownSigma(200);
  EXPECT_DOUBLE_EQ(rule.Loss(150), -50);
  EXPECT_NEAR(rule.Loss(200), 0, 1e-12);
  EXPECT_NEAR(rule.Loss(20000), 200 * std::log(100.0), 1e-9);
  EXPECT_NEAR((rule.Loss(201) - rule.Loss(199)) / 2, 1, 0.01) << "continuous in its slope";
}

TEST(EvidenceRule, WithoutASigmaOnlyRatiosCount) {
  EvidenceRule rule = KnownSigma(100);
  rule.sigma_known = false;
  EXPECT_NEAR(rule.Loss(8) - rule.Loss(4), rule.Loss(8e6) - rule.Loss(4e6), 1e-9);
}

TEST(SetEvaluator, FindsTheLeastSquaresOfASet) {
  Rng rng(1);
  const MatrixXd C = RandomMatrix(80, 5, &rng);
  const VectorXd y = RandomMatrix(80, 1, &rng);
  std::vector<GramItem> items;
  for (int k = 0; k < 5; ++k) items.push_back(OneColumn(std::to_string(k), k));
  SetEvaluator evaluator(GramOfRows(C, y), items, KnownSigma(80));
  const std::vector<int> set = {0, 3, 4};
  const MatrixXd own = C(Eigen::all, set);
  const VectorXd x = own.colPivHouseholderQr().solve(y);
  const SetValue& value = evaluator.Evaluate(set);
  EXPECT_NEAR(value.rss, (y - own * x).squaredNorm(), 1e-6);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(value.values[static_cast<std::size_t>(k)][0], x[k], 1e-6);
}

TEST(SetEvaluator, KeepsSignsThatMustBePositiveAndFitsTheOthersBesideZero) {
  Rng rng(2);
  const MatrixXd C = RandomMatrix(60, 2, &rng);
  const VectorXd y = C.col(0) * 3 - C.col(1) * 2;
  SetEvaluator evaluator(
      GramOfRows(C, y), {OneColumn("a", 0), OneColumn("b", 1, true)}, KnownSigma(60));
  const SetValue& both = evaluator.Evaluate({0, 1});
  EXPECT_EQ(both.values[1][0], 0);
  EXPECT_NEAR(both.values[0][0], C.col(0).dot(y) / C.col(0).squaredNorm(), 1e-6);
  EXPECT_GT(both.evidence, evaluator.Evaluate({0}).evidence + 1e5) << "a name of no size is none";
}

TEST(SetEvaluator, SizesBeyondTheLargestAreNoExplanation) {
  Rng rng(3);
  const MatrixXd C = RandomMatrix(60, 1, &rng);
  GramItem item = OneColumn("a", 0);
  item.typical = VectorXd::Constant(1, 1.0);
  const auto evidence_of = [&](double size) {
    SetEvaluator evaluator(GramOfRows(C, size * C.col(0)), {item}, KnownSigma(60));
    const SetValue& value = evaluator.Evaluate({0});
    return value.evidence - evaluator.rule().Loss(value.rss) - evaluator.price(0);
  };
  EXPECT_NEAR(evidence_of(1), 0, 1e-6);
  EXPECT_NEAR(evidence_of(10), 1 / (kTuning.size_decades * kTuning.size_decades), 1e-6);
  EXPECT_GT(evidence_of(1000), 500);
}

TEST(SetEvaluator, PromisesOfSinglesAndPairsAreWhatTheyAreWorth) {
  Rng rng(4);
  const MatrixXd C = RandomMatrix(100, 6, &rng);
  const VectorXd y = RandomMatrix(100, 1, &rng) + 2 * C.col(1) + 2 * C.col(4);
  std::vector<GramItem> items;
  for (int k = 0; k < 6; ++k) items.push_back(OneColumn(std::to_string(k), k));
  SetEvaluator evaluator(GramOfRows(C, y), items, KnownSigma(100));
  const auto promises = evaluator.Larger({2}, true);
  ASSERT_FALSE(promises.empty());
  for (const auto& promise : promises) {
    EXPECT_NEAR(promise.evidence, evaluator.Evaluate(promise.set).evidence, 1e-3);
  }
}

TEST(SetEvaluator, AColumnThatTheGeometryTakesCostsAndGivesNothing) {
  MatrixXd G = MatrixXd::Identity(2, 2);
  G(1, 1) = 1e-12;  // of squares 1 before the geometry was taken out
  Gram gram{G, VectorXd::Zero(2), VectorXd::Ones(2), 50};
  gram.b << 5, 1e-12;
  GramItem both;
  both.id = "a";
  both.size = 2;
  both.positive = {false, false};
  SetEvaluator evaluator(gram, {both}, KnownSigma(50));
  EXPECT_NEAR(evaluator.price(0), evaluator.rule().Price(1, 1, true), 1e-12);
  EXPECT_NEAR(evaluator.Larger({}, false).front().evidence,
              evaluator.rule().Loss(25) + evaluator.price(0),
              1e-6);
}

TEST(ItemSets, AreKeptInOrder) {
  EXPECT_EQ(With({1, 5}, 3), (ItemSet{1, 3, 5}));
  EXPECT_EQ(Without({1, 3, 5}, {3}), (ItemSet{1, 5}));
}

}  // namespace
}  // namespace dhcal
