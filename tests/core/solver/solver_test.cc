#include "core/solver/solver.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/curve_problem.h"

namespace dhcal {
namespace {

using ::testing::HasSubstr;

class EverySolver : public ::testing::TestWithParam<SolverMethod> {
 protected:
  SolverSummary Solve(const CurveCase& curve, const SolverOptions& options) const {
    return MakeSolver(GetParam())->Solve(options, MakeCurveProblem(curve).get());
  }
};

TEST_P(EverySolver, FindsTheTruthOfExactReadings) {
  SolverOptions options;
  options.kappa = 0;
  const SolverSummary summary = Solve(CurveCase(), options);
  EXPECT_TRUE(summary.Converged()) << summary.message;
  EXPECT_NEAR(summary.state[0], 0.1, 1e-10);
  EXPECT_NEAR(summary.state[1], -0.2, 1e-10);
  EXPECT_NEAR(summary.state[2], 0.3, 1e-10);
}

TEST_P(EverySolver, StopsOnKappaAfterApplyingTheStepThatPassed) {
  SolverOptions options;
  options.kappa = 1e-9;
  const SolverSummary summary = Solve(CurveCase(), options);
  EXPECT_EQ(summary.termination, Termination::kKappa);
  EXPECT_LE(summary.trace.back().kappa_norm, options.kappa);
  // The linear model is exact from the first: Gauss-Newton needs one step, and it was taken.
  if (GetParam() == SolverMethod::kSvdGaussNewton) {
    EXPECT_EQ(summary.trace.size(), 1u);
  }
  for (std::size_t k = 0; k + 1 < summary.trace.size(); ++k) {
    EXPECT_GT(summary.trace[k].kappa_norm, options.kappa);
  }
  EXPECT_GT(std::abs(summary.state[1]), 0.1);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

TEST_P(EverySolver, NoiseKeepsKappaOutOfReachAndTheMessageSaysWhatStopped) {
  CurveCase curve;
  curve.noise_step = 1e-3;
  const SolverSummary summary = Solve(curve, SolverOptions());
  EXPECT_EQ(summary.termination, Termination::kSmallChange);
  EXPECT_GT(summary.trace.back().kappa_norm, 1e-8);
  EXPECT_FALSE(summary.message.empty());
}

TEST_P(EverySolver, IterationLimitIsUsableButNotConverged) {
  SolverOptions options;
  options.kappa = 0;
  options.max_iterations = 1;
  const SolverSummary summary = Solve(CurveCase(), options);
  EXPECT_EQ(summary.termination, Termination::kIterationLimit);
  EXPECT_TRUE(summary.IsSolutionUsable());
  EXPECT_FALSE(summary.Converged());
}

TEST_P(EverySolver, CorrectionBeyondItsLimitIsDiverged) {
  CurveCase curve;
  curve.limit = 0.25;
  const SolverSummary summary = Solve(curve, SolverOptions());
  EXPECT_EQ(summary.termination, Termination::kDiverged);
  EXPECT_THAT(summary.message, HasSubstr("0.3"));
  EXPECT_FALSE(summary.IsSolutionUsable());
}

TEST_P(EverySolver, TraceCarriesRankKappaNormAndFallingCost) {
  SolverOptions options;
  options.kappa = 0;
  const SolverSummary summary = Solve(CurveCase(), options);
  double cost = summary.initial_cost;
  int iteration = 0;
  for (const IterationRecord& record : summary.trace) {
    EXPECT_EQ(record.iteration, ++iteration);
    EXPECT_EQ(record.rank, 3);
    EXPECT_LE(record.cost, cost);
    EXPECT_TRUE(std::isfinite(record.kappa_norm));
    EXPECT_TRUE(std::isfinite(record.step_norm));
    cost = record.cost;
  }
}

TEST_P(EverySolver, DirectionWithoutReadingsStaysWhereItStarted) {
  CurveCase curve;
  curve.x = {-1, 1, -1, 1};  // a and c cannot be told apart
  const SolverSummary summary = Solve(curve, SolverOptions());
  ASSERT_TRUE(summary.IsSolutionUsable()) << summary.message;
  EXPECT_EQ(summary.trace.back().rank, 2);
  EXPECT_NEAR(summary.state[1], -0.2, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Solvers,
                         EverySolver,
                         ::testing::Values(SolverMethod::kSvdGaussNewton,
                                           SolverMethod::kLevenbergMarquardt),
                         [](const auto& test) { return ToString(test.param); });

TEST(SolverOptions, NamesFieldValueAndRuleWhenInvalid) {
  SolverOptions options;
  std::string error;
  EXPECT_TRUE(options.IsValid(&error));
  options.kappa = -1;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("kappa = -1 violates kappa >= 0"));
}

TEST(SolverSummary, SaysThatNothingRanUntilItDid) {
  const SolverSummary summary;
  EXPECT_EQ(summary.termination, Termination::kNotRun);
  EXPECT_FALSE(summary.IsSolutionUsable());
  EXPECT_THAT(summary.message, HasSubstr("not called"));
}

TEST(TruncatedGaussNewton, KeepsWhatTheRuleKeeps) {
  CurveCase curve;
  // The quadratic term is seen with s = 0.02 only: less than one tolerance.
  curve.x = {-0.1, -0.05, 0, 0.05, 0.1};
  curve.sigma = 0.5;
  SolverOptions options;
  options.kappa = 0;
  const auto solver = MakeSolver(SolverMethod::kSvdGaussNewton);
  const auto solve = [&] { return solver->Solve(options, MakeCurveProblem(curve).get()); };
  EXPECT_EQ(solve().trace.back().rank, 1);
  options.truncation = {TruncationRule::kRelative, 1e-6};
  EXPECT_EQ(solve().trace.back().rank, 3);
  options.truncation = {TruncationRule::kPaper, 0};
  EXPECT_EQ(solve().trace.back().rank, 3);
}

TEST(TruncatedGaussNewton, TakesAShorterStepWhereTheWholeOneWouldRaiseTheCost) {
  // r = a + 400 a^2 - y with its solution near a = 0.1: the step from zero is far too long.
  CurveCase curve;
  curve.curvature = 400;
  curve.sigma = 1;
  curve.limit = 1e6;
  SolverOptions options;
  options.kappa = 0;
  options.truncation = {TruncationRule::kRelative, 1e-12};
  const SolverSummary damped =
      MakeSolver(SolverMethod::kSvdGaussNewton)->Solve(options, MakeCurveProblem(curve).get());
  ASSERT_TRUE(damped.Converged()) << damped.message;
  double cost = damped.initial_cost;
  for (const IterationRecord& record : damped.trace) {
    EXPECT_LE(record.cost, cost);
    cost = record.cost;
  }
  EXPECT_LT(damped.final_cost, 1e-6 * damped.initial_cost);
  options.truncation = {TruncationRule::kPaper, 0};
  const SolverSummary plain =
      MakeSolver(SolverMethod::kSvdGaussNewton)->Solve(options, MakeCurveProblem(curve).get());
  ASSERT_FALSE(plain.trace.empty());
  EXPECT_GT(plain.trace[0].cost, plain.initial_cost);
}

TEST(TruncatedGaussNewton, IsTheTruncatedStepWhereThatLowersTheCost) {
  CurveCase curve;
  curve.noise_step = 1e-3;
  const auto problem = MakeCurveProblem(curve);
  Linearization linearization;
  ASSERT_TRUE(Linearize(problem.get(), &linearization));
  const TruncatedSvd svd = Truncate(Truncation(), problem->scales.tolerance, linearization);
  SolverOptions options;
  options.max_iterations = 1;
  const SolverSummary summary =
      MakeSolver(SolverMethod::kSvdGaussNewton)->Solve(options, problem.get());
  EXPECT_LT((summary.state - svd.Solve(linearization.b)).norm(), 1e-10);
}

}  // namespace
}  // namespace dhcal
