// Against dense covariance matrices, and noise made by its definition.
#include "core/math/slow_noise.h"

#include <cmath>
#include <cstdint>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/random_matrix.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ReadingOrder InRuns(int readings, int per_run, int coordinates) {
  ReadingOrder order;
  order.coordinates = coordinates;
  for (int k = 0; k < readings; ++k) {
    order.sequence.push_back(k / per_run);
    order.place.push_back(k + k / 7);  // every seventh reading is missing
  }
  return order;
}

/// Of values reading by reading, by the definition.
MatrixXd Covariance(const SlowNoise& noise, const ReadingOrder& order) {
  const int m = order.coordinates, n = order.num_readings();
  MatrixXd covariance = (1 - noise.share) * MatrixXd::Identity(m * n, m * n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      if (order.sequence[a] != order.sequence[b]) continue;
      const int apart = std::abs(order.place[a] - order.place[b]);
      for (int k = 0; k < m; ++k) {
        covariance(m * i + k, m * j + k) += noise.share * std::pow(noise.persistence, apart);
      }
    }
  }
  return covariance;
}

MatrixXd Operator(const SlowNoiseFilter& filter, int size) {
  MatrixXd W = MatrixXd::Identity(size, size);
  for (int k = 0; k < size; ++k) filter.Whiten(W.col(k));
  return W;
}

class SlowNoiseFilterTest : public testing::TestWithParam<SlowNoise> {};

TEST_P(SlowNoiseFilterTest, IsTheRootOfTheInverseCovariance) {
  const ReadingOrder order = InRuns(25, 10, 2);
  const SlowNoiseFilter filter(GetParam(), order);
  const MatrixXd W = Operator(filter, 50), C = Covariance(GetParam(), order);
  EXPECT_LT((W * C * W.transpose() - MatrixXd::Identity(50, 50)).cwiseAbs().maxCoeff(), 1e-12);
  const Eigen::LLT<MatrixXd> factor(C);
  const double log_determinant =
      2 * factor.matrixLLT().diagonal().array().log().sum() / order.coordinates;
  EXPECT_NEAR(filter.log_determinant(), log_determinant, 1e-11);
}

TEST_P(SlowNoiseFilterTest, HasItsAdjointAndItsPrecision) {
  const ReadingOrder order = InRuns(25, 10, 2);
  const SlowNoiseFilter filter(GetParam(), order);
  const MatrixXd W = Operator(filter, 50);
  Rng rng(3);
  VectorXd v = RandomMatrix(50, 1, &rng);
  const VectorXd expected = W.transpose() * v;
  filter.WhitenAdjoint(v);
  EXPECT_LT((v - expected).cwiseAbs().maxCoeff(), 1e-13);
  const MatrixXd Q = W.transpose() * W;
  const SlowNoiseFilter::Precision precision = filter.PrecisionOf();
  for (int k = 0; k < 25; ++k) {
    EXPECT_NEAR(precision.own[k], Q(2 * k, 2 * k), 1e-12) << k;
    if (k == 0) continue;
    EXPECT_NEAR(precision.with_before[k], Q(2 * k, 2 * k - 2), 1e-12) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Noises,
                         SlowNoiseFilterTest,
                         testing::Values(SlowNoise{0.3, 0.9},
                                         SlowNoise{0.05, 0.985},
                                         SlowNoise{1, 0.5},
                                         SlowNoise{0.7, 0.2},
                                         SlowNoise{}));

VectorXd Wandering(const SlowNoise& noise, const ReadingOrder& order, std::uint64_t seed) {
  Rng rng(seed);
  const Eigen::LLT<MatrixXd> factor(Covariance(noise, order));
  return factor.matrixL() * RandomMatrix(order.coordinates * order.num_readings(), 1, &rng).col(0);
}

TEST(FindSlowNoise, FindsWhatWasMade) {
  for (const SlowNoise& noise : {SlowNoise{0.3, 0.9}, SlowNoise{0.5, 0.97}, SlowNoise{1, 0.5}}) {
    const ReadingOrder order = InRuns(300, 150, 3);
    double correlation = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const LikeliestSlowNoise found = FindSlowNoise(Wandering(noise, order, seed), order);
      EXPECT_GT(found.evidence, 16) << noise.share << ", " << seed;
      correlation += found.noise.correlation() / 10;
    }
    EXPECT_NEAR(correlation, noise.correlation(), 0.1) << noise.share;
  }
}

TEST(FindSlowNoise, IsRareInWhiteNoise) {
  const ReadingOrder order = InRuns(100, 100, 3);
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    if (FindSlowNoise(Wandering(SlowNoise(), order, seed), order).evidence > 12) ++found;
  }
  EXPECT_LE(found, 3) << "chi-square with two degrees of freedom exceeds 12 once in 400";
}

}  // namespace
}  // namespace dhcal
