#include "residuals/prior.h"

#include <gtest/gtest.h>

#include "tests/support/matchers.h"

namespace dhcal {
namespace {

TEST(PriorBlock, IsEachCorrectionInItsSigmas) {
  const PriorBlock block({{2, 0.05}, {0, 0.5}}, 3);
  const double x[] = {1.0, 7.0, 0.2};
  const double* const parameters[] = {x};
  Eigen::Vector2d r;
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> J;
  J.setConstant(9);
  double* jacobians[] = {J.data()};
  ASSERT_TRUE(block.Evaluate(parameters, r.data(), jacobians));
  EXPECT_THAT(r, MatrixNear(Eigen::Vector2d(4, 2), 1e-14));
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(2, 3);
  expected(0, 2) = 20;
  expected(1, 0) = 2;
  EXPECT_THAT(J, MatrixNear(expected, 1e-14));
  jacobians[0] = nullptr;
  EXPECT_TRUE(block.Evaluate(parameters, r.data(), jacobians));
  EXPECT_TRUE(block.Evaluate(parameters, r.data(), nullptr));
}

}  // namespace
}  // namespace dhcal
