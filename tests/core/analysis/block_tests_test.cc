#include "core/analysis/block_tests.h"

#include <cmath>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/math/statistics.h"

namespace dhcal {
namespace {

constexpr int kRows = 120;
constexpr int kGeometry = 6;
constexpr int kBlocks = 12;

/// Rows with a geometry of six columns and a dozen blocks of two.
struct System {
  Eigen::MatrixXd U, X;
  std::vector<ColumnRange> blocks;

  explicit System(std::uint64_t seed) {
    Rng rng(seed);
    Eigen::MatrixXd J(kRows, kGeometry);
    for (double& value : J.reshaped()) value = rng.Normal();
    U = Eigen::MatrixXd::Identity(kRows, kGeometry);
    U = J.householderQr().householderQ() * U;
    X.resize(kRows, 2 * kBlocks);
    for (double& value : X.reshaped()) value = rng.Normal();
    for (int b = 0; b < kBlocks; ++b) blocks.push_back({2 * b, 2});
  }

  BlockTests Tests(const Eigen::VectorXd& y_raw, bool sigma_known) const {
    const Eigen::MatrixXd M_X = X - U * (U.transpose() * X);
    const Eigen::VectorXd y = y_raw - U * (U.transpose() * y_raw);
    BlockGram gram;
    gram.S = M_X.transpose() * M_X;
    gram.z = M_X.transpose() * y;
    gram.norm2 = X.colwise().squaredNorm();
    gram.rss = y.squaredNorm();
    gram.nu = kRows - kGeometry;
    gram.sigma_known = sigma_known;
    return BlockTests(gram, blocks, std::vector<bool>(blocks.size(), true), 500, 11);
  }
};

Eigen::VectorXd Noise(std::uint64_t seed) {
  Rng rng(seed);
  Eigen::VectorXd y(kRows);
  for (double& value : y) value = rng.Normal();
  return y;
}

/// Residual squares of y on geometry and some columns, by plain least squares.
double Rss(const System& setup, const Eigen::VectorXd& y, const std::vector<int>& columns) {
  Eigen::MatrixXd A(kRows, kGeometry + static_cast<Eigen::Index>(columns.size()));
  A << setup.U, setup.X(Eigen::all, columns);
  return (y - A * A.colPivHouseholderQr().solve(y)).squaredNorm();
}

TEST(BlockTests, ScoreIsTheDropOfSquaresOfAPlainFit) {
  const System setup(1);
  const Eigen::VectorXd y = Noise(2) + setup.X.col(4);
  const BlockTests tests = setup.Tests(y, true);
  BlockModel model;
  model.columns = {0, 1, 7};
  const auto scores = tests.Scores(model);
  const double expected = Rss(setup, y, {0, 1, 7}) - Rss(setup, y, {0, 1, 7, 4, 5});
  EXPECT_NEAR(scores[2].Q, expected, 1e-9 * expected);
  EXPECT_EQ(scores[2].k, 2);
  EXPECT_NEAR(scores[2].p, ChiSquareTail(expected, 2), 1e-12);
  EXPECT_EQ(scores[0].k, 0) << "the block is in the model already";
  EXPECT_NEAR(tests.Removed(model), Rss(setup, y, {}) - Rss(setup, y, {0, 1, 7}), 1e-9);
}

TEST(BlockTests, ChanceTakesWhatIsLeftAsNoiseWhateverSigmaIs) {
  const System setup(3);
  // Block 2 in noise of fifty times the stated size, beside block 1.
  const Eigen::VectorXd y = 50 * Noise(4) + setup.X.col(4) * 20;
  const double without = Rss(setup, y, {2, 3}), with = Rss(setup, y, {2, 3, 4, 5});
  const BlockTests tests = setup.Tests(y, /*sigma_known=*/true);
  BlockModel model;
  model.columns = {2, 3};
  for (const int together : {1, 3}) {
    const double rest = static_cast<double>(kRows - kGeometry - 2) / together - 2;
    const double F = (without - with) / 2 / (with / rest);
    const std::vector<double> chances = tests.Chances(model, {5, 2}, together);
    EXPECT_NEAR(chances[1], FTail(F, 2, rest), 1e-9) << together;
    EXPECT_GT(chances[0], 1e-3);
  }
  EXPECT_LT(tests.Score(model, 2).p, 1e-20);
}

TEST(BlockTests, EstimateIsThatOfAPlainFit) {
  const System setup(3);
  const Eigen::VectorXd y = Noise(4);
  BlockModel model;
  model.columns = {2, 3};
  Eigen::MatrixXd A(kRows, kGeometry + 2);
  A << setup.U, setup.X.middleCols(2, 2);
  const Eigen::VectorXd plain = A.colPivHouseholderQr().solve(y).tail(2);
  EXPECT_LT((setup.Tests(y, true).Estimate(model) - plain).norm(), 1e-10);
}

class FalseAlarm : public testing::TestWithParam<bool> {};

TEST_P(FalseAlarm, OfTheMaximumIsItsLevel) {
  const System setup(5);
  constexpr int kDraws = 400;
  int alarms = 0;
  for (int k = 0; k < kDraws; ++k) {
    const BlockTests tests = setup.Tests(Noise(100 + static_cast<std::uint64_t>(k)), GetParam());
    alarms += tests.Test({}, 0.05).p <= 0.05 ? 1 : 0;
  }
  // 400 draws at 5 %: 20 expected, standard deviation 4.4.
  EXPECT_GE(alarms, 7);
  EXPECT_LE(alarms, 35);
}

INSTANTIATE_TEST_SUITE_P(SigmaKnownOrNot, FalseAlarm, testing::Bool());

TEST(BlockTests, TheTrueModelIsKeptAtItsLevelWhateverItsSize) {
  const System setup(6);
  constexpr int kDraws = 300;
  int rejected = 0;
  BlockModel model;
  model.columns = {8, 9};
  for (int k = 0; k < kDraws; ++k) {
    const Eigen::VectorXd y = Noise(1000 + static_cast<std::uint64_t>(k)) +
                              setup.X.middleCols(8, 2) * Eigen::Vector2d(20, -30);
    rejected += setup.Tests(y, false).Test(model, 0.05).p <= 0.05 ? 1 : 0;
  }
  EXPECT_GE(rejected, 4);
  EXPECT_LE(rejected, 28);
}

TEST(BlockTests, SoftColumnsTakeUpWhatTheirSpreadAllows) {
  const System setup(7);
  const Eigen::VectorXd y = Noise(8) + 100 * setup.X.col(0) + 8 * setup.X.col(2);
  BlockModel hard;
  hard.columns = {0, 1};
  const BlockTests tests = setup.Tests(y, true);
  EXPECT_LT(tests.Test(hard, 0.05).p, 0.01);
  BlockModel soft = hard;
  soft.soft = {2};
  soft.soft_sigma = Eigen::VectorXd::Constant(1, 10.0);
  EXPECT_GT(tests.Test(soft, 0.05).p, 0.05);
  soft.soft_sigma[0] = 0.1;
  EXPECT_LT(tests.Test(soft, 0.05).p, 0.01);
}

TEST(BlockTests, LackOfFitShowsNoiseThatIsLargerThanStated) {
  const System setup(9);
  const BlockTests tests = setup.Tests(1.6 * Noise(10), true);
  const ModelTest test = tests.Test({}, 0.05);
  EXPECT_LT(test.p, 0.01);
  EXPECT_EQ(test.worst, -1);
}

}  // namespace
}  // namespace dhcal
