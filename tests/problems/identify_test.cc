#include "problems/identify.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "residuals/registry.h"
#include "tests/support/problem_cases.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

using ::testing::HasSubstr;

constexpr double kSigma = 20e-6;  // [m]

struct Case {
  TrueRobot truth;
  ProblemSpec spec;
  Recording recording;
};

Case MakeCase(int poses, std::uint64_t seed) {
  RecordingPlan plan;
  plan.poses = poses;
  plan.seed = seed;
  Case made{MakeTrueRobot(Ur10(), seed),
            MakeSpec(Ur10(), KindNamed("position"), NoiseKind::kIndependent),
            Recording()};
  made.recording = Record(made.truth, made.spec, plan);
  return made;
}

Result Solve(const Case& made) { return IdentifyGeometry(made.spec, made.recording, Progress()); }

TEST(Identify, TestRowsAreNeverFitted) {
  Case made = MakeCase(200, 1);
  made.recording.is_test.assign(200, false);
  for (int k = 150; k < 200; ++k) {
    made.recording.is_test[static_cast<std::size_t>(k)] = true;
    made.recording.p_WQ.row(k).array() += 0.5;  // nonsense that a fit would show
  }
  const Result result = Solve(made);
  EXPECT_EQ(result.rows, 150);
  EXPECT_EQ(result.rows_test, 50);
  EXPECT_NEAR(result.best()->rms, kSigma, 0.15 * kSigma);
  EXPECT_EQ(result.validation.method, "set column");
  EXPECT_NEAR(result.validation.rms_test, 0.5, 1e-3);
}

TEST(Identify, BlockedFoldsPredictAsWellAsNewRows) {
  const Result result = Solve(MakeCase(300, 2));
  EXPECT_EQ(result.validation.method, "blocked k-fold");
  EXPECT_GT(result.validation.rms_test, result.validation.rms_train);
  EXPECT_NEAR(result.validation.rms_test / kSigma, 1.0, 0.15);
}

TEST(Identify, LeveragesAddUpToTheRank) {
  const Result result = Solve(MakeCase(120, 3));
  double sum = 0;
  for (const RowResidual& row : result.residuals) sum += row.leverage;
  EXPECT_NEAR(sum, result.best()->rank, 1e-6);
}

TEST(Identify, SigmaPerRowWeighsRows) {
  Case made = MakeCase(200, 4);
  Rng rng(4);
  made.recording.sigma = Eigen::VectorXd::Constant(200, kSigma);
  for (int k = 0; k < 100; ++k) {
    made.recording.sigma[k] = 100 * kSigma;
    for (int axis = 0; axis < 3; ++axis) {
      made.recording.p_WQ(k, axis) += 100 * kSigma * rng.Normal();
    }
  }
  const Result weighed = Solve(made);
  EXPECT_EQ(weighed.noise_source, "given per row");
  EXPECT_NEAR(weighed.best()->chi2_reduced, 1.0, 0.2);
  EXPECT_LT(PredictionError(made.truth, made.spec, weighed.calibrated, 9), 2 * kSigma);
}

TEST(Identify, RobustLossesShrugOffOutliers) {
  Case made = MakeCase(200, 5);
  for (int k = 0; k < 200; k += 20) made.recording.p_WQ(k, k % 3) += 5e-3;
  const double plain = PredictionError(made.truth, made.spec, Solve(made).calibrated, 9);
  for (const LossKind loss : {LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey}) {
    made.spec.solver.loss = loss;
    made.spec.solver.loss_scale = 3;
    const Result result = Solve(made);
    ASSERT_NE(result.best(), nullptr);
    const double robust = PredictionError(made.truth, made.spec, result.calibrated, 9);
    EXPECT_LT(robust, 0.2 * plain);
    EXPECT_LT(robust, 3 * kSigma);
    EXPECT_NEAR(result.noise_sigma / kSigma, 1.0, 0.3);
  }
}

TEST(Identify, PriorHoldsWhatTheReadingsDoNotDetermine) {
  Case made = MakeCase(150, 6);
  made.spec.parameters.prior_sigma["d"] = 1e-4;
  const auto parameters = ByName(*Solve(made).best());
  // d2, d3, d4 share one sum: each keeps its prior's share of the doubt, and no more.
  EXPECT_LT(parameters.at("d2").sigma, 1.01e-4);
  EXPECT_GT(parameters.at("d2").sigma, 0.5e-4);
}

TEST(Identify, TargetsHaveToolsOfTheirOwn) {
  Case made = MakeCase(150, 7);
  RobotModel& robot = made.spec.robot;
  const Eigen::Isometry3d nominal = robot.X_TQ;
  // The same point under two names, the second drawn 8 mm beside it.
  robot.targets = {{"A", nominal}, {"B", nominal}};
  robot.targets[1].X_TQ.translation().x() += 8e-3;
  made.recording.target_names = {"A", "B"};
  for (int k = 0; k < 150; ++k) made.recording.target_idx.push_back(k % 2);
  const Result result = Solve(made);
  EXPECT_NEAR(result.best()->rms, kSigma, 0.2 * kSigma);
  const Eigen::Vector3d a = result.calibrated.targets[0].X_TQ.translation();
  const Eigen::Vector3d b = result.calibrated.targets[1].X_TQ.translation();
  EXPECT_LT((a - b).norm(), 4 * kSigma);
  EXPECT_EQ(ByName(*result.best()).count("tool_x.B"), 1u);
}

TEST(Identify, NoiseIsEstimatedFromTheRowsThatStateNone) {
  Case made = MakeCase(200, 8);
  made.recording.sigma.setConstant(200, kNotSet);
  // Stated ten times too small: these rows misfit, which is no reason to widen the others.
  for (int k = 0; k < 200; k += 2) made.recording.sigma[k] = kSigma / 10;
  EXPECT_NEAR(Solve(made).noise_sigma / kSigma, 1.0, 0.2);
}

TEST(Identify, TheStatedSigmaIsForBlankCellsOnly) {
  Case made = MakeCase(200, 8);
  made.spec.measurement.sigma = kSigma / 5;
  made.recording.sigma.setConstant(200, 2 * kSigma);
  EXPECT_DOUBLE_EQ(Solve(made).noise_sigma, 2 * kSigma);
}

TEST(Identify, ARowWithoutAReadingNeedsNoSigma) {
  Case made = MakeCase(200, 8);
  made.recording.sigma.setConstant(200, 2 * kSigma);
  made.recording.p_WQ.row(17).setConstant(kNotSet);
  made.recording.sigma[17] = kNotSet;
  const Result result = Solve(made);
  EXPECT_EQ(result.noise_source, "given per row");
  EXPECT_EQ(result.rows, 199);
}

TEST(CheckEnoughReadings, RowsThatNeverFollowEachOtherGiveNoDisplacement) {
  Case made = MakeCase(40, 5);
  made.spec.measurement.kind = KindNamed("adjacent_position");
  for (int k = 0; k < 40; ++k) {
    made.recording.run_names.push_back(std::to_string(k));
    made.recording.run_idx.push_back(k);
  }
  Diagnostics diagnostics;
  CheckEnoughReadings(made.spec, made.recording, &diagnostics);
  EXPECT_THAT(diagnostics.ToString(),
              HasSubstr("no two consecutive rows share run, target, edge and set"));
}

TEST(CheckEnoughReadings, NoiseCannotBeEstimatedFromAsManyNumbersAsParameters) {
  Case made = MakeCase(1, 5);
  made.spec.parameters.estimate = {"theta1", "theta2", "theta3"};
  made.spec.measurement.sigma.reset();
  Diagnostics unknown, given;
  CheckEnoughReadings(made.spec, made.recording, &unknown);
  EXPECT_THAT(unknown.ToString(), HasSubstr("measurement.sigma_mm"));
  made.spec.measurement.sigma = kSigma;
  CheckEnoughReadings(made.spec, made.recording, &given);
  EXPECT_TRUE(given.ok()) << given.ToString();
}

TEST(Identify, BasePerRunIsRegisteredAnew) {
  Case made = MakeCase(200, 8);
  made.spec.robot.base_per_run = true;
  made.recording.run_names = {"morning", "evening"};
  const Eigen::Isometry3d moved = MakeFrame({1.5, -0.3, 0.2}, {0.2, -0.1, 2.0});
  for (int k = 0; k < 200; ++k) {
    made.recording.run_idx.push_back(k < 100 ? 0 : 1);
    if (k < 100) continue;
    const Eigen::Vector3d p = made.recording.p_WQ.row(k);
    made.recording.p_WQ.row(k) = moved * p;
  }
  const Result result = Solve(made);
  EXPECT_NEAR(result.best()->rms, kSigma, 0.2 * kSigma);
  ASSERT_EQ(result.calibrated.base_of_run.size(), 2u);
  const Eigen::Isometry3d found =
      result.calibrated.base_of_run[1].X * result.calibrated.base_of_run[0].X.inverse();
  EXPECT_LT((found.linear() - moved.linear()).norm(), 1e-4);
  ASSERT_EQ(result.residuals.size(), 200u);
  EXPECT_EQ(result.residuals[99].run, "morning");
  EXPECT_EQ(result.residuals[100].run, "evening");
}

TEST(Identify, SimulatedUnitsOfNoiseAreFoundForPoses) {
  Case made = MakeCase(200, 9);
  made.spec.measurement.kind = KindNamed("pose");
  RecordingPlan plan;
  plan.poses = 200;
  plan.sigma_rotation = 80e-6;
  made.recording = Record(made.truth, made.spec, plan);
  const Result result = Solve(made);
  EXPECT_NEAR(result.noise_sigma / kSigma, 1.0, 0.15);
  EXPECT_NEAR(result.noise_sigma_rotation / 80e-6, 1.0, 0.15);
}

TEST(Identify, CovarianceOfCeresAgreesWithTheSvd) {
  // With undetermined directions, and with none.
  const Case complete = MakeCase(200, 10);
  Case few = complete;
  few.spec.parameters.estimate = {"theta2", "theta3", "a2", "a3", "alpha1", "base"};
  for (const Case& made : {complete, few}) {
    const Result result = Solve(made);
    EXPECT_LE(result.best()->rank, result.best()->columns);
    EXPECT_LT(result.best()->covariance_difference, 1e-9);
    EXPECT_THAT(result.best()->covariance_check, HasSubstr("are those of ceres::Covariance"));
  }
}

TEST(Identify, TooFewReadingsAreAnInputError) {
  const Case made = MakeCase(10, 11);
  Diagnostics diagnostics;
  CheckEnoughReadings(made.spec, made.recording, &diagnostics);
  ASSERT_EQ(diagnostics.num_errors(), 1);
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("fewer than the 38 free parameters"));
}

TEST(Identify, NothingToEstimateIsAnInputError) {
  Case made = MakeCase(50, 12);
  made.spec.parameters.estimate = {"a"};
  made.spec.parameters.fix = {"a"};
  Diagnostics diagnostics;
  CheckEnoughReadings(made.spec, made.recording, &diagnostics);
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("nothing is left to estimate"));
}

TEST(Identify, ScaleIsSaidToBeHiddenAlways) {
  const Result result = Solve(MakeCase(100, 13));
  EXPECT_THAT(result.notes.back(), HasSubstr("scale error"));
}

}  // namespace
}  // namespace dhcal
