// A plan's figures are those that calibrations at its poses have, and better than those of random
// poses. Truth: tests/support/recorder.h.
#include "problems/plan/plan.h"

#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "problems/identify.h"
#include "residuals/registry.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

constexpr double kPlanSigma = 20e-6;

RobotModel LimitedKr15() {
  RobotModel robot = Kr15();
  const double low[] = {-185, -55, -220, -350, -130, -350};
  const double high[] = {185, 135, 64, 350, 130, 350};
  for (std::size_t k = 0; k < 6; ++k) {
    robot.joints[k].lower = low[k] * kDegree;
    robot.joints[k].upper = high[k] * kDegree;
  }
  return robot;
}

ProblemSpec PositionProblem() {
  ProblemSpec spec = MakeSpec(LimitedKr15(), KindNamed("position"), NoiseKind::kIndependent);
  spec.measurement.sigma = kPlanSigma;
  spec.task.emplace();
  spec.task->box = TaskBox{{0.7, -0.4, 0.3}, {1.3, 0.4, 1.0}};
  return spec;
}

PlanOptions SmallPlan(int count) {
  PlanOptions options;
  options.count = count;
  options.candidates = 200;
  return options;
}

const PlannedError& RowOf(const Plan& plan, int count) {
  for (const PlannedError& error : plan.errors) {
    if (error.count == count) return error;
  }
  ADD_FAILURE() << "no row for " << count;
  return plan.errors.front();
}

/// Readings of the true robot at poses.
Recording ReadOfTruth(const TrueRobot& truth, const Eigen::MatrixXd& q, std::uint64_t seed) {
  Rng rng(seed);
  Recording rows;
  rows.q = q;
  rows.p_WQ.resize(q.rows(), 3);
  for (Eigen::Index row = 0; row < q.rows(); ++row) {
    const Eigen::Matrix4d X = truth.Pose(q.row(row).transpose());
    for (int k = 0; k < 3; ++k) rows.p_WQ(row, k) = X(k, 3) + kPlanSigma * rng.Normal();
  }
  return rows;
}

/// RMS in the region of the task of a calibration with these rows [m].
double ErrorInTask(const ProblemSpec& spec, const TrueRobot& truth, const Recording& rows) {
  const Result result = IdentifyGeometry(spec, rows, {});
  if (result.best() == nullptr) return HUGE_VAL;
  const DhChain chain(result.calibrated);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(chain.slots().size());
  double sum = 0;
  for (Eigen::Index k = 0; k < result.task->q.rows(); ++k) {
    const Eigen::VectorXd q = result.task->q.row(k).transpose();
    const Eigen::Vector3d p =
        chain.Pose<double>(q, none, {result.calibrated.X_WB, result.calibrated.X_TQ}).translation();
    sum += (p - truth.Pose(q).block<3, 1>(0, 3)).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(result.task->q.rows()));
}

TEST(PlanPoses, PredictsTheErrorThatCalibrationsAtItsPosesHave) {
  const ProblemSpec spec = PositionProblem();
  Diagnostics diagnostics;
  const auto plan = PlanPoses(spec, nullptr, SmallPlan(40), &diagnostics);
  ASSERT_TRUE(plan.has_value()) << diagnostics.ToString();
  ASSERT_EQ(plan->rows.num_rows(), 40);
  constexpr int kDraws = 20;
  double squares = 0;
  for (std::uint64_t draw = 1; draw <= kDraws; ++draw) {
    const TrueRobot truth = MakeTrueRobot(spec.robot, draw);
    squares += std::pow(ErrorInTask(spec, truth, ReadOfTruth(truth, plan->rows.q, draw)), 2);
  }
  // Some thirty directions, each draw: the mean square is known to a tenth.
  EXPECT_NEAR(std::sqrt(squares / kDraws) / RowOf(*plan, 40).rms, 1, 0.2);
}

TEST(PlanPoses, IsBetterThanRandomPosesByBothCriteria) {
  const ProblemSpec spec = PositionProblem();
  Diagnostics diagnostics;
  PlanOptions options = SmallPlan(30);
  const auto for_parameters = PlanPoses(spec, nullptr, options, &diagnostics);
  options.criterion = DesignCriterion::kI;
  const auto for_region = PlanPoses(spec, nullptr, options, &diagnostics);
  ASSERT_TRUE(for_parameters && for_region) << diagnostics.ToString();
  EXPECT_LT(RowOf(*for_parameters, 30).rms, 0.9 * RowOf(*for_parameters, 30).rms_random);
  EXPECT_LE(RowOf(*for_region, 30).rms, RowOf(*for_parameters, 30).rms);
}

TEST(PlanPoses, StaysWithinLimitsAndVolume) {
  const ProblemSpec spec = PositionProblem();
  PlanOptions options = SmallPlan(20);
  options.volume = TaskBox{{0.2, -0.8, 0.1}, {1.6, 0.8, 1.6}};
  Diagnostics diagnostics;
  const auto plan = PlanPoses(spec, nullptr, options, &diagnostics);
  ASSERT_TRUE(plan.has_value()) << diagnostics.ToString();
  const DhChain chain(spec.robot);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(chain.slots().size());
  for (Eigen::Index row = 0; row < plan->rows.q.rows(); ++row) {
    const Eigen::VectorXd q = plan->rows.q.row(row).transpose();
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_GE(q[static_cast<Eigen::Index>(k)], spec.robot.joints[k].lower);
      EXPECT_LE(q[static_cast<Eigen::Index>(k)], spec.robot.joints[k].upper);
    }
    const Eigen::Vector3d p =
        chain.Pose<double>(q, none, {Eigen::Isometry3d::Identity(), spec.robot.X_TQ}).translation();
    EXPECT_TRUE((p.array() >= options.volume->low.array()).all());
    EXPECT_TRUE((p.array() <= options.volume->high.array()).all());
  }
}

TEST(PlanPoses, ErrorsFallByTheRootOfTheNumber) {
  Diagnostics diagnostics;
  const auto plan = PlanPoses(PositionProblem(), nullptr, SmallPlan(60), &diagnostics);
  ASSERT_TRUE(plan.has_value()) << diagnostics.ToString();
  for (std::size_t k = 1; k < plan->errors.size(); ++k) {
    EXPECT_LT(plan->errors[k].rms, plan->errors[k - 1].rms);
  }
  EXPECT_NEAR(RowOf(*plan, 30).rms / RowOf(*plan, 60).rms, std::sqrt(2), 0.25);
  ASSERT_GT(plan->enough, 0);
  const double floor = std::sqrt(3) * kPlanSigma;
  EXPECT_LE(std::hypot(RowOf(*plan, plan->enough).rms, floor), 1.1 * floor);
}

TEST(PlanPoses, JudgesTheUsersOwnReadings) {
  const ProblemSpec spec = PositionProblem();
  const TrueRobot truth = MakeTrueRobot(spec.robot, 3);
  // Poses that differ little.
  Rng rng(5);
  Eigen::MatrixXd q(60, 6);
  for (double& angle : q.reshaped()) angle = 0.6 + rng.Uniform(-0.2, 0.2);
  const Recording own = ReadOfTruth(truth, q, 3);
  Diagnostics diagnostics;
  const auto plan = PlanPoses(spec, &own, SmallPlan(60), &diagnostics);
  ASSERT_TRUE(plan && plan->own) << diagnostics.ToString();
  EXPECT_EQ(plan->own->count, 60);
  EXPECT_GT(plan->own->rms, 3 * RowOf(*plan, 60).rms);
  EXPECT_GT(plan->own_matched_by, 0);
  EXPECT_LT(plan->own_matched_by, 60);
}

TEST(PlanPoses, NeedsTheNoiseAndCandidatesEnough) {
  ProblemSpec spec = PositionProblem();
  Diagnostics diagnostics;
  PlanOptions options = SmallPlan(20);
  options.volume = TaskBox{{5, 5, 5}, {6, 6, 6}};
  EXPECT_FALSE(PlanPoses(spec, nullptr, options, &diagnostics).has_value());
  EXPECT_THAT(diagnostics.ToString(), testing::HasSubstr("only 0 poses in the volume"));
  spec.measurement.sigma.reset();
  EXPECT_FALSE(PlanPoses(spec, nullptr, SmallPlan(20), &diagnostics).has_value());
  EXPECT_THAT(diagnostics.ToString(), testing::HasSubstr("state 'measurement.sigma_mm'"));
}

TEST(PlanPoses, DifferencesArePlannedAsThePosesThatTheyAreOf) {
  ProblemSpec spec = MakeSpec(
      WithPlainEnds(LimitedKr15()), KindNamed("adjacent_position"), NoiseKind::kSharedPose);
  spec.measurement.sigma = kPlanSigma;
  Diagnostics diagnostics;
  const auto plan = PlanPoses(spec, nullptr, SmallPlan(30), &diagnostics);
  ASSERT_TRUE(plan.has_value()) << diagnostics.ToString();
  EXPECT_EQ(plan->rows.num_rows(), 30);
  EXPECT_LT(RowOf(*plan, 30).rms, RowOf(*plan, 30).rms_random);
}

}  // namespace
}  // namespace dhcal
