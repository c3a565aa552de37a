#include "core/analysis/ceres_covariance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/solver/linearization.h"
#include "core/solver/truncation.h"
#include "tests/support/curve_problem.h"
#include "tests/support/matchers.h"

namespace dhcal {
namespace {

using ::testing::HasSubstr;

Identifiability Analysed(EstimationProblem* problem) {
  Linearization readings, all;
  EXPECT_TRUE(Linearize(problem, &all, &readings));
  return Identify(readings, all, problem->scales.tolerance, 5);
}

TEST(CovarianceByCeres, IsTheInverseOfTheNormalMatrixWhereAllIsDetermined) {
  const auto problem = MakeCurveProblem(CurveCase());
  const Identifiability identifiability = Analysed(problem.get());
  ASSERT_EQ(identifiability.all.rank, 3);
  const auto covariance = CovarianceByCeres(identifiability.all, problem.get());
  ASSERT_TRUE(covariance.has_value());
  Linearization linear;
  ASSERT_TRUE(Linearize(problem.get(), &linear));
  const Eigen::MatrixXd expected = (linear.R.transpose() * linear.R).inverse();
  EXPECT_THAT(*covariance, MatrixNear(expected, 1e-10 * expected.norm()));
}

TEST(CovarianceByCeres, AgreesWithTheSvdForEveryParameterAlsoWithAHiddenDirection) {
  CurveCase curve;
  curve.x = {-1, 1, -1, 1};  // a and c cannot be told apart
  const auto problem = MakeCurveProblem(curve);
  const Identifiability identifiability = Analysed(problem.get());
  ASSERT_EQ(identifiability.all.rank, 2);
  const auto covariance = CovarianceByCeres(identifiability.all, problem.get());
  const CovarianceCheck check = CompareSigmas(covariance, identifiability);
  EXPECT_TRUE(check.agrees) << check.sentence;
  EXPECT_LT(check.difference, 1e-9);
  EXPECT_THAT(check.sentence, HasSubstr("all 3 parameters"));
}

TEST(CompareSigmas, SaysThatTheyDisagreeWhenTheyDo) {
  const auto problem = MakeCurveProblem(CurveCase());
  Identifiability identifiability = Analysed(problem.get());
  const auto covariance = CovarianceByCeres(identifiability.all, problem.get());
  identifiability.covariance(1, 1) *= 1.0001;
  const CovarianceCheck check = CompareSigmas(covariance, identifiability);
  EXPECT_FALSE(check.agrees);
  EXPECT_NEAR(check.difference, 5e-5, 1e-6);
  EXPECT_THAT(check.sentence, HasSubstr("WARNING"));
  EXPECT_FALSE(CompareSigmas(std::nullopt, identifiability).agrees);
}

}  // namespace
}  // namespace dhcal
