// The exchange finds designs that are known to be the best ones.
#include "problems/plan/exchange.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace dhcal {
namespace {

/// Rows 1, x, x^2 at places of [-1, 1], so exact that the tolerances say nothing beside them.
std::vector<Eigen::MatrixXd> Parabola(int places) {
  std::vector<Eigen::MatrixXd> blocks;
  for (int k = 0; k < places; ++k) {
    const double x = -1 + 2.0 * k / (places - 1);
    blocks.emplace_back(1e4 * Eigen::RowVector3d(1, x, x * x));
  }
  return blocks;
}

std::vector<Eigen::MatrixXd> RandomBlocks(int count, int columns) {
  Rng rng(3);
  std::vector<Eigen::MatrixXd> blocks;
  for (int k = 0; k < count; ++k) {
    Eigen::MatrixXd rows(2, columns);
    for (double& entry : rows.reshaped()) entry = 5 * rng.Normal();
    blocks.push_back(rows);
  }
  return blocks;
}

Eigen::MatrixXd InformationOfChoice(const std::vector<Eigen::MatrixXd>& blocks,
                                    const std::vector<int>& chosen) {
  const Eigen::Index columns = blocks[0].cols();
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(columns, columns);
  for (const int k : chosen) {
    const Eigen::MatrixXd& A = blocks[static_cast<std::size_t>(k)];
    M += A.transpose() * A;
  }
  return M;
}

/// Calls `visit` with every choice of three.
template <typename Visit>
void ForEachTriple(int count, const Visit& visit) {
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      for (int c = b + 1; c < count; ++c) visit(std::vector<int>{a, b, c});
    }
  }
}

TEST(Exchange, TakesTheEndsAndTheMiddleForAParabola) {
  // The D-optimal design of a parabola on [-1, 1] is {-1, 0, 1} (Guest 1958).
  const std::vector<Eigen::MatrixXd> blocks = Parabola(21);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(3, 3);
  Exchange exchange(blocks, DesignCriterion::kD, none);
  exchange.Choose(3);
  std::vector<int> chosen = exchange.chosen();
  std::sort(chosen.begin(), chosen.end());
  EXPECT_EQ(chosen, (std::vector<int>{0, 10, 20}));
}

TEST(Exchange, IsAsGoodAsTryingAllForD) {
  const std::vector<Eigen::MatrixXd> blocks = RandomBlocks(14, 5);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(5, 5);
  double best = 0;
  ForEachTriple(14, [&](const std::vector<int>& chosen) {
    best = std::max(best, std::log(InformationOfChoice(blocks, chosen).determinant()));
  });
  Exchange exchange(blocks, DesignCriterion::kD, none);
  exchange.Choose(3);
  EXPECT_NEAR(
      std::log(InformationOfChoice(blocks, exchange.chosen()).determinant()), best, 0.05 * best);
}

TEST(Exchange, MakesNoSingleExchangeThatGainsForI) {
  const std::vector<Eigen::MatrixXd> blocks = RandomBlocks(14, 5);
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(5, 5);
  weights.diagonal() << 1, 0, 4, 0, 0.1;
  const auto value = [&](const std::vector<int>& chosen) {
    return (weights * InformationOfChoice(blocks, chosen).inverse()).trace();
  };
  Exchange exchange(blocks, DesignCriterion::kI, weights);
  exchange.Choose(4);
  const double reached = value(exchange.chosen());
  EXPECT_NEAR((weights * exchange.covariance()).trace(), reached, 1e-10 * reached);
  for (std::size_t place = 0; place < 4; ++place) {
    for (int other = 0; other < 14; ++other) {
      std::vector<int> changed = exchange.chosen();
      if (std::find(changed.begin(), changed.end(), other) != changed.end()) continue;
      changed[place] = other;
      EXPECT_GE(value(changed), reached * (1 - 1e-5)) << place << " " << other;
    }
  }
}

TEST(Exchange, TakesEachCandidateOnce) {
  const std::vector<Eigen::MatrixXd> blocks = Parabola(9);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(3, 3);
  Exchange exchange(blocks, DesignCriterion::kD, none);
  exchange.Choose(20);
  std::vector<int> chosen = exchange.chosen();
  std::sort(chosen.begin(), chosen.end());
  EXPECT_EQ(chosen.size(), 9U);
  EXPECT_EQ(std::unique(chosen.begin(), chosen.end()), chosen.end());
}

}  // namespace
}  // namespace dhcal
