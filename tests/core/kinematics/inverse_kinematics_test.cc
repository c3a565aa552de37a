// Inverse kinematics, judged by the forward kinematics of tests/support.
#include "core/kinematics/inverse_kinematics.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/math/rotation.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::HasSubstr;

Isometry3d IndependentPose(const RobotModel& robot, const VectorXd& q, const VectorXd& delta) {
  Isometry3d X;
  X.matrix() = independent::ForwardKinematics<double>(robot, q, delta);
  return X;
}

ChainState StateOf(const RobotModel& robot, const VectorXd& delta) {
  return {delta, {robot.X_WB, robot.X_TQ}};
}

double Turn(const Isometry3d& a, const Isometry3d& b) {
  return LogSO3(Eigen::Matrix3d(a.linear() * b.linear().transpose())).norm();
}

/// Poses of random joints, whether or not an arm is singular there.
TEST(InverseKinematics, BringsTheToolOfEveryRobotToItsPoseFromNearby) {
  for (const RobotModel& robot : {Kr15(), Kr15Modified(), Ur10(), Panda(), Scara()}) {
    const InverseKinematics inverse(robot);
    Rng rng(5);
    int found = 0, singular = 0;
    constexpr int kPoses = 100;
    for (int k = 0; k < kPoses; ++k) {
      const VectorXd truth = RandomJoints(robot, &rng);
      const VectorXd delta = RandomSlots(robot, 1e-3, &rng);
      const Isometry3d X = IndependentPose(robot, truth, delta);
      VectorXd seed = truth;
      for (double& value : seed) value += rng.Uniform(-0.02, 0.02);
      const InverseSolution solution = inverse.Solve(X, StateOf(robot, delta), seed);
      if (!solution.found) {
        singular += solution.reason.find("singular") == 0 ? 1 : 0;
        continue;
      }
      ++found;
      const Isometry3d reached = IndependentPose(robot, solution.q, delta);
      EXPECT_LT((reached.translation() - X.translation()).norm(), 1e-9) << robot.name;
      EXPECT_LT(Turn(reached, X), 1e-9) << robot.name;
      // The branch of the seed.
      if (robot.num_joints() <= 6) {
        EXPECT_LT((solution.q - truth).lpNorm<Eigen::Infinity>(), 0.3) << robot.name << k;
      }
    }
    EXPECT_GE(found, 95) << robot.name << ", singular " << singular;
  }
}

TEST(InverseKinematics, RedundantArmsMoveLittleFromTheirSeed) {
  const RobotModel robot = Panda();
  const InverseKinematics inverse(robot);
  Rng rng(6);
  const VectorXd none = VectorXd::Zero(SlotLayout(7).size());
  for (int k = 0; k < 50; ++k) {
    const VectorXd seed = RandomJoints(robot, &rng);
    Isometry3d X = IndependentPose(robot, seed, none);
    X.translation() += 1e-3 * Vector3d(rng.Normal(), rng.Normal(), rng.Normal());
    const InverseSolution solution = inverse.Solve(X, StateOf(robot, none), seed);
    if (!solution.found) continue;
    const auto J = independent::ComplexStep(robot, seed, none);
    Eigen::MatrixXd J_q(6, 7);
    for (int joint = 0; joint < 7; ++joint) {
      J_q.col(joint) << J.J_p.col(5 * joint), J.J_w.col(5 * joint);
    }
    const VectorXd moved = solution.q - seed;
    // To first order the shortest move: nothing along the arm's own motion.
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J_q, Eigen::ComputeFullV);
    EXPECT_LT(std::abs(svd.matrixV().col(6).dot(moved)), 0.1 * moved.norm() + 1e-4);
  }
}

TEST(InverseKinematics, FewerThanSixJointsReachThePlaceAndComeNearTheOrientation) {
  const RobotModel robot = Scara();
  const InverseKinematics inverse(robot);
  Rng rng(7);
  const VectorXd none = VectorXd::Zero(SlotLayout(robot.num_joints()).size());
  for (int k = 0; k < 50; ++k) {
    const VectorXd seed = RandomJoints(robot, &rng);
    Isometry3d X = IndependentPose(robot, seed, none);
    const Vector3d tilt(2e-3, -1e-3, 0);
    X.linear() = X.linear() * ExpSO3<double>(tilt);
    const InverseSolution solution = inverse.Solve(X, StateOf(robot, none), seed);
    ASSERT_TRUE(solution.found) << solution.reason;
    const Isometry3d reached = IndependentPose(robot, solution.q, none);
    EXPECT_LT((reached.translation() - X.translation()).norm(), 1e-9);
    EXPECT_NEAR(Turn(reached, X), solution.rotation_error, 1e-9);
    EXPECT_LT(solution.rotation_error, 3e-3);
  }
}

TEST(InverseKinematics, FindsItsWayFromAFarSeed) {
  const RobotModel robot = Kr15();
  const InverseKinematics inverse(robot);
  Rng rng(8);
  const VectorXd none = VectorXd::Zero(SlotLayout(6).size());
  int found = 0;
  for (int k = 0; k < 100; ++k) {
    const VectorXd truth = RandomJoints(robot, &rng);
    VectorXd seed = truth;
    for (double& value : seed) value += rng.Uniform(-0.4, 0.4);
    const Isometry3d X = IndependentPose(robot, truth, none);
    const InverseSolution solution = inverse.Solve(X, StateOf(robot, none), seed);
    if (!solution.found) continue;
    ++found;
    EXPECT_LT((IndependentPose(robot, solution.q, none).matrix() - X.matrix()).norm(), 1e-9);
  }
  EXPECT_GE(found, 85);
}

TEST(InverseKinematics, RefusesWhatIsOutOfReach) {
  const RobotModel robot = Kr15();
  const InverseKinematics inverse(robot);
  Isometry3d X = robot.X_WB;
  X.translation() += Vector3d(0, 0, 5);
  const VectorXd none = VectorXd::Zero(SlotLayout(6).size());
  VectorXd seed(6);
  seed << 0.1, 0.5, 0.3, 0.2, 0.8, 0.1;
  const InverseSolution solution = inverse.Solve(X, StateOf(robot, none), seed);
  EXPECT_FALSE(solution.found);
  EXPECT_THAT(solution.reason, HasSubstr("out of reach"));
  EXPECT_GT(solution.position_error, 2.0);
}

TEST(InverseKinematics, RespectsLimitsAndTriesWholeTurns) {
  RobotModel robot = Kr15();
  const VectorXd none = VectorXd::Zero(SlotLayout(6).size());
  VectorXd q(6);
  q << 0.3, 1.0, -0.4, 0.7, 0.9, 2.9;
  const Isometry3d X = IndependentPose(robot, q, none);
  VectorXd seed = q;
  seed[3] += 0.01;

  robot.joints[5].lower = -350 * kDegree;
  robot.joints[5].upper = 90 * kDegree;
  const InverseSolution turned = InverseKinematics(robot).Solve(X, StateOf(robot, none), seed);
  ASSERT_TRUE(turned.found) << turned.reason;
  EXPECT_NEAR(turned.q[5], 2.9 - 2 * kPi, 1e-9);

  robot.joints[1].lower = -90 * kDegree;
  robot.joints[1].upper = 45 * kDegree;
  const InverseSolution refused = InverseKinematics(robot).Solve(X, StateOf(robot, none), seed);
  EXPECT_FALSE(refused.found);
  EXPECT_THAT(refused.reason, HasSubstr("joint 2 would have to go to 57.30 deg"));
  EXPECT_THAT(refused.reason, HasSubstr("limits -90 to 45 deg"));
}

TEST(InverseKinematics, RedundantArmsGoAroundALimit) {
  RobotModel robot = Panda();
  const VectorXd none = VectorXd::Zero(SlotLayout(7).size());
  VectorXd q(7);
  q << 0.2, 0.6, -0.3, -1.6, 0.4, 1.7, 0.5;
  const Isometry3d X = IndependentPose(robot, q, none);
  // Joint 3 must give way, and the other joints take over.
  robot.joints[2].lower = -0.25;
  robot.joints[2].upper = 2;
  const InverseSolution solution = InverseKinematics(robot).Solve(X, StateOf(robot, none), q);
  ASSERT_TRUE(solution.found) << solution.reason;
  EXPECT_GE(solution.q[2], -0.25);
  EXPECT_LT((IndependentPose(robot, solution.q, none).matrix() - X.matrix()).norm(), 1e-9);
}

TEST(InverseKinematics, RefusesSingularPoses) {
  for (const TestRobot& robot : TestRobots()) {
    if (robot.model.num_joints() != 6) continue;
    const VectorXd none = VectorXd::Zero(SlotLayout(6).size());
    for (const NamedPose& pose : robot.poses) {
      const Isometry3d X = IndependentPose(robot.model, pose.q, none);
      const InverseSolution solution =
          InverseKinematics(robot.model).Solve(X, StateOf(robot.model, none), pose.q);
      EXPECT_EQ(solution.found, !pose.singular) << robot.model.name << " " << pose.name;
      if (!pose.singular) continue;
      EXPECT_THAT(solution.reason, HasSubstr("singular:")) << pose.name;
    }
  }
}

}  // namespace
}  // namespace dhcal
