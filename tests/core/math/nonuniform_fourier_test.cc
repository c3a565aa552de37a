#include "core/math/nonuniform_fourier.h"

#include <complex>

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace dhcal {
namespace {

TEST(NonuniformFourier, EqualsTheSumItStandsForAtEveryFrequency) {
  Rng rng(3);
  constexpr int kPoints = 200, kFrequencies = 150;
  Eigen::VectorXd points(kPoints), weights(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    points[i] = rng.Uniform(-20, 20);  // several turns, negative too
    weights[i] = rng.Normal();
  }
  const Eigen::ArrayXcd sums = NonuniformFourier(points, kFrequencies).Sums(weights);
  ASSERT_EQ(sums.size(), kFrequencies);
  for (int k = 0; k < kFrequencies; ++k) {
    std::complex<double> expected = 0;
    for (int i = 0; i < kPoints; ++i) expected += weights[i] * std::polar(1.0, k * points[i]);
    EXPECT_LT(std::abs(sums[k] - expected), 1e-5 * weights.lpNorm<1>()) << k;
  }
}

TEST(NonuniformFourier, OfOneFrequencyIsThePlainSum) {
  const Eigen::VectorXd points = Eigen::Vector3d(0.1, 2, -3);
  const Eigen::VectorXd weights = Eigen::Vector3d(1, 2, 4);
  EXPECT_NEAR(NonuniformFourier(points, 1).Sums(weights)[0].real(), 7, 1e-4);
}

}  // namespace
}  // namespace dhcal
