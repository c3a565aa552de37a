#include "problems/diagnosis/judge/certainty.h"

#include <cmath>

#include <gtest/gtest.h>

#include "problems/diagnosis/tuning.h"
#include "tests/support/matchers.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Certainty WithCovariance(const VectorXd& value, const MatrixXd& C) {
  Certainty certainty;
  certainty.value = value;
  certainty.sigma = C.diagonal().cwiseSqrt();
  ShowWhatIsHeld(C, &certainty);
  return certainty;
}

TEST(ShowWhatIsHeld, LeavesAValueThatIsCertain) {
  const VectorXd value = (VectorXd(2) << 1, 5).finished();
  const Certainty c = WithCovariance(value, MatrixXd::Identity(2, 2));
  EXPECT_EQ(c.shown_value, value);
  EXPECT_EQ(c.shown_sigma, c.sigma);
}

TEST(ShowWhatIsHeld, ShowsTheSumOfTwoOfWhichOnlyTheSumIsKnown) {
  // The difference is known to 100, the sum to 0.1: neither value alone is certain.
  const double wide = 100 * 100, narrow = 0.1 * 0.1;
  MatrixXd C(2, 2);
  C << wide + narrow, narrow - wide, narrow - wide, wide + narrow;
  C /= 2;
  // 3 along the sum, 20 (a fifth of a sigma) along the difference.
  const VectorXd value = (VectorXd(2) << 3 + 20, 3 - 20).finished() / std::sqrt(2.0);
  const Certainty c = WithCovariance(value, C);
  EXPECT_THAT(c.shown_value, MatrixNear(VectorXd::Constant(2, 3 / std::sqrt(2.0)), 1e-4));
  EXPECT_THAT(c.shown_sigma, MatrixNear(VectorXd::Constant(2, 0.1 / std::sqrt(2.0)), 1e-3));
  EXPECT_EQ(c.value, value) << "what is fitted stays";
}

TEST(ShowWhatIsHeld, OfNothingCertainKeepsTheMostCertainDirection) {
  const VectorXd value = (VectorXd(2) << 1.5, 0.1).finished();
  const Certainty c = WithCovariance(value, MatrixXd::Identity(2, 2));
  EXPECT_LT(std::abs(c.shown_value[0]) / std::max(c.shown_sigma[0], 1e-300),
            kTuning.least_certain + 1e-9);
}

}  // namespace
}  // namespace dhcal
