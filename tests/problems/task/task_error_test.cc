// The errors announced for a task's region are those that calibrations have there. Truth:
// tests/support/recorder.h.
#include "problems/task/task_error.h"

#include <cmath>
#include <cstdint>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "problems/identify.h"
#include "problems/task/points.h"
#include "problems/task/region.h"
#include "residuals/registry.h"
#include "tests/support/random_matrix.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

constexpr double kTaskSigma = 50e-6;

ProblemSpec SpecWithBox(const RobotModel& robot) {
  ProblemSpec spec = MakeSpec(robot, KindNamed("position"), NoiseKind::kIndependent);
  spec.measurement.sigma = kTaskSigma;
  spec.task.emplace();
  spec.task->box = TaskBox{{0.7, -0.4, 0.3}, {1.3, 0.4, 1.0}};
  return spec;
}

TEST(TaskError, IsTheErrorThatPredictionsHaveThere) {
  constexpr int kDraws = 25;
  double squares = 0;
  int inside = 0;
  for (std::uint64_t draw = 1; draw <= kDraws; ++draw) {
    const TrueRobot truth = MakeTrueRobot(Kr15(), draw);
    const ProblemSpec spec = SpecWithBox(truth.nominal);
    const Result result =
        IdentifyGeometry(spec, Record(truth, spec, {60, kTaskSigma, 0, draw}), {});
    ASSERT_TRUE(result.task.has_value());
    const TaskError& task = *result.task;
    ASSERT_EQ(task.unknown, "");
    const DhChain chain(result.calibrated);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(chain.slots().size());
    double sum = 0;
    for (Eigen::Index k = 0; k < task.q.rows(); ++k) {
      const Eigen::VectorXd q = task.q.row(k).transpose();
      const Eigen::Vector3d p =
          chain.Pose<double>(q, none, {result.calibrated.X_WB, result.calibrated.X_TQ})
              .translation();
      sum += (p - truth.Pose(q).block<3, 1>(0, 3)).squaredNorm();
    }
    const double rms = std::sqrt(sum / static_cast<double>(task.q.rows()));
    squares += rms * rms / (task.after.rms * task.after.rms);
    inside += rms > task.after.low && rms < task.after.high ? 1 : 0;
    // The nominal robot is off by what was put in, some millimetres at a metre's reach.
    EXPECT_GT(task.before.rms, 5 * task.after.rms);
    EXPECT_LT(task.before.low, task.before.rms);
    EXPECT_GT(task.before.high, task.before.rms);
  }
  EXPECT_NEAR(squares / kDraws, 1, 0.35);
  // 95 % of 25: fewer than 20 have a chance of 0.2 %.
  EXPECT_GE(inside, 20);
}

TEST(TaskError, OfAKnownWeightedSumOfSquaresHasItsQuantiles) {
  // J'J C of three equal weights: 3 w times chi-square with three degrees of freedom over three.
  const Eigen::MatrixXd J = std::sqrt(2.0) * Eigen::MatrixXd::Identity(3, 3);
  const RegionError error = ExpectedError(J, Eigen::MatrixXd::Identity(3, 3));
  EXPECT_NEAR(error.rms, std::sqrt(6.0), 1e-12);
  // Quantiles 0.025 and 0.975 of chi-square with three degrees of freedom: 0.2158, 9.3484.
  EXPECT_NEAR(error.low, std::sqrt(2 * 0.2158), 1e-3);
  EXPECT_NEAR(error.high, std::sqrt(2 * 9.3484), 1e-3);
}

TEST(TaskError, CountsWhatNoReadingShowsAsHiddenRisk) {
  // Only the wrist moves: what the first joints' rows hold is not seen, and moves the box.
  const TrueRobot truth = MakeTrueRobot(Kr15(), 5);
  const ProblemSpec spec = SpecWithBox(truth.nominal);
  Recording wide = Record(truth, spec, {60, kTaskSigma, 0, 5});
  Recording narrow = wide;
  for (int row = 0; row < narrow.num_rows(); ++row) {
    narrow.q.row(row).head(3) = wide.q.row(0).head(3);
    narrow.p_WQ.row(row) = truth.Pose(narrow.q.row(row).transpose()).block<3, 1>(0, 3).transpose();
  }
  const Result all = IdentifyGeometry(spec, wide, {});
  const Result wrist = IdentifyGeometry(spec, narrow, {});
  ASSERT_TRUE(all.task && wrist.task);
  EXPECT_GT(wrist.task->hidden, 1e-3);
  EXPECT_LT(all.task->hidden, 1e-4);
}

TEST(TaskError, SaysThatABoxIsOutOfReach) {
  ProblemSpec spec = SpecWithBox(Kr15());
  spec.task->box = TaskBox{{9, 9, 9}, {10, 10, 10}};
  const TaskError task = TaskPoses(spec);
  EXPECT_THAT(task.unknown, testing::HasSubstr("reaches next to nothing of the box"));
  EXPECT_LT(task.poses, 10);
}

TEST(DrawInBox, PosesAreInTheBoxWithinTheLimits) {
  RobotModel robot = Kr15();
  for (JointRow& joint : robot.joints) {
    joint.lower = -2.0;
    joint.upper = 1.5;
  }
  // So small that draws of joints alone do not fill it.
  const TaskBox box{{0.8, -0.05, 0.6}, {0.9, 0.05, 0.7}};
  const Eigen::MatrixXd poses = DrawInBox(robot, box, 50, 1);
  ASSERT_EQ(poses.rows(), 50);
  const DhChain chain(robot);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(chain.slots().size());
  for (Eigen::Index k = 0; k < poses.rows(); ++k) {
    const Eigen::VectorXd q = poses.row(k).transpose();
    EXPECT_GE(q.minCoeff(), -2.0);
    EXPECT_LE(q.maxCoeff(), 1.5);
    const Eigen::Vector3d p =
        chain.Pose<double>(q, none, {Eigen::Isometry3d::Identity(), robot.X_TQ}).translation();
    EXPECT_TRUE((p.array() > box.low.array() - 1e-9).all()) << p.transpose();
    EXPECT_TRUE((p.array() < box.high.array() + 1e-9).all()) << p.transpose();
  }
}

TEST(WithoutMotion, TakesAwayRigidMotionsAndNothingElse) {
  Rng rng(2);
  Eigen::Matrix3Xd points(3, 20);
  for (double& entry : points.reshaped()) entry = rng.Normal();
  const Eigen::Vector3d turn(0.3, -0.2, 0.5), shift(1, 2, 3);
  Eigen::Matrix3Xd motion = points.colwise().cross(-turn);
  motion.colwise() += shift;
  EXPECT_LT(WithoutMotion(points, motion.reshaped()).norm(), 1e-12);
  // A stretch is no motion, and is at right angles to all of them about the middle.
  const Eigen::Matrix3Xd stretch = points.colwise() - points.rowwise().mean();
  EXPECT_LT((WithoutMotion(points, stretch.reshaped()) - stretch.reshaped()).norm(), 1e-12);
}

}  // namespace
}  // namespace dhcal
