#include "residuals/prior.h"

#include <limits>

#include <gtest/gtest.h>

namespace dhcal {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(PriorResidual, IsTheDistanceFromWhatWasExpectedInSigmas) {
  const PriorResidual block(0.1, 0.05);
  const double x = 0.3;
  const double* const parameters[] = {&x};
  double r = kNaN, J = kNaN;
  double* jacobians[] = {&J};
  ASSERT_TRUE(block.Evaluate(parameters, &r, jacobians));
  EXPECT_DOUBLE_EQ(r, 4.0);
  EXPECT_DOUBLE_EQ(J, 20.0);
}

TEST(PriorResidual, IsZeroWhereExpected) {
  const PriorResidual block(-2e-3, 1e-6);
  const double x = -2e-3;
  const double* const parameters[] = {&x};
  double r = kNaN;
  ASSERT_TRUE(block.Evaluate(parameters, &r, nullptr));
  EXPECT_EQ(r, 0.0);
  double* jacobians[] = {nullptr};
  EXPECT_TRUE(block.Evaluate(parameters, &r, jacobians));
}

}  // namespace
}  // namespace dhcal
