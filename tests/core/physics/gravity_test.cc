#include "core/physics/gravity.h"

#include <cmath>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/physics/worked_example.h"

namespace dhcal {
namespace {

Recording RandomRows(int rows, std::uint64_t seed) {
  Rng rng(seed);
  Recording recording;
  recording.q.resize(rows, 6);
  for (double& q : recording.q.reshaped()) q = rng.Uniform(-kPi, kPi);
  return recording;
}

/// Potential energy of links and payload, from the frames alone.
double Potential(const RobotModel& robot,
                 const DhChain& chain,
                 const Eigen::VectorXd& q,
                 double payload) {
  const auto frames = chain.LinkFrames(q);
  double energy = 0;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const LinkMass& link = robot.links[static_cast<std::size_t>(i)];
    energy -= link.mass * robot.gravity_B.dot(frames[static_cast<std::size_t>(i + 1)] * link.p_LC);
  }
  return energy - payload * robot.gravity_B.dot(frames.back() * robot.payload.p_LC);
}

RobotModel LoadedRobot() {
  RobotModel robot = WorkedExampleRobot();
  Rng rng(3);
  for (LinkMass& link : robot.links) {
    link.mass = rng.Uniform(2, 50);
    link.p_LC = Eigen::Vector3d(rng.Normal(), rng.Normal(), rng.Normal()) * 0.2;
  }
  robot.payload = {7, Eigen::Vector3d(0.1, 0.02, 0.15)};
  return robot;
}

TEST(GravityTorque, IsMinusTheSlopeOfThePotentialEnergy) {
  const RobotModel robot = LoadedRobot();
  const DhChain chain(robot);
  const Recording rows = RandomRows(8, 5);
  const PhysicsContext context(robot, rows, {robot.X_WB});
  constexpr double kStep = 1e-5;
  for (int joint = 0; joint < 6; ++joint) {
    const Eigen::VectorXd torque = GravityTorque(context, MassCases(context, joint).front(), joint);
    for (int k = 0; k < rows.num_rows(); ++k) {
      Eigen::VectorXd up = rows.q.row(k), down = up;
      up[joint] += kStep;
      down[joint] -= kStep;
      const double slope =
          (Potential(robot, chain, up, 7) - Potential(robot, chain, down, 7)) / (2 * kStep);
      EXPECT_NEAR(torque[k], -slope, 1e-5 * 500);
    }
  }
}

TEST(GravityTorque, UsesThePayloadOfEachRow) {
  const RobotModel robot = LoadedRobot();
  Recording rows = RandomRows(2, 6);
  rows.q.row(1) = rows.q.row(0);
  rows.payload = Eigen::Vector2d(0, 10);
  const PhysicsContext context(robot, rows, {robot.X_WB});
  const Eigen::VectorXd torque = GravityTorque(context, MassCases(context, 1).front(), 1);
  const Eigen::Vector3d p = context.X_BL(0, 5) * robot.payload.p_LC;
  const double expected =
      context.axis(0, 1).dot((p - context.axis_point(0, 1)).cross(10 * robot.gravity_B));
  EXPECT_NEAR(torque[1] - torque[0], expected, 1e-9);
}

TEST(MassCases, WithoutMassesSpanEveryDistributionOfMass) {
  const RobotModel loaded = LoadedRobot();
  RobotModel unknown = loaded;
  unknown.links.clear();
  unknown.payload = LinkMass();
  const Recording rows = RandomRows(60, 7);
  for (int joint = 1; joint < 6; ++joint) {
    const PhysicsContext known(loaded, rows, {loaded.X_WB});
    const PhysicsContext blind(unknown, rows, {unknown.X_WB});
    const auto cases = MassCases(blind, joint);
    Eigen::MatrixXd basis(rows.num_rows(), static_cast<Eigen::Index>(cases.size()));
    for (std::size_t k = 0; k < cases.size(); ++k) {
      basis.col(static_cast<Eigen::Index>(k)) = GravityTorque(blind, cases[k], joint);
    }
    const Eigen::VectorXd truth = GravityTorque(known, MassCases(known, joint).front(), joint);
    const Eigen::VectorXd left = truth - basis * basis.colPivHouseholderQr().solve(truth);
    EXPECT_LT(left.norm(), 1e-9 * truth.norm()) << "joint " << joint + 1;
    EXPECT_EQ(basis.colPivHouseholderQr().rank(), basis.cols()) << "joint " << joint + 1;
  }
}

TEST(GravityLoads, NotTheUprightFirstJoint) {
  const RobotModel robot = LoadedRobot();
  const Recording rows = RandomRows(20, 8);
  const PhysicsContext context(robot, rows, {robot.X_WB});
  EXPECT_FALSE(GravityLoads(context, 0));
  EXPECT_EQ(FirstLoadedJoint(context), 1);
}

TEST(GravityLoads, TheFirstJointOfARobotOnTheWall) {
  RobotModel robot = LoadedRobot();
  robot.gravity_B = Eigen::Vector3d(-9.80665, 0, 0);
  const Recording rows = RandomRows(20, 8);
  const PhysicsContext context(robot, rows, {robot.X_WB});
  EXPECT_TRUE(GravityLoads(context, 0));
}

TEST(PhysicsContext, TwistsAsBaseSlotsMoveTheToolAsTheyShould) {
  RobotModel robot = LoadedRobot();
  robot.X_WB = Eigen::Translation3d(0.3, -0.2, 0.1) *
               Eigen::Isometry3d(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  const Recording rows = RandomRows(1, 9);
  const PhysicsContext context(robot, rows, {robot.X_WB});
  Twist twist;
  twist.at = Eigen::Vector3d(0.4, 0.1, 0.9);
  twist.rotation = Eigen::Vector3d(1e-6, -2e-6, 3e-6);
  twist.translation = Eigen::Vector3d(2e-6, 1e-6, -1e-6);
  const DhChain chain(robot);
  Eigen::VectorXd delta = Eigen::VectorXd::Zero(chain.slots().size());
  const EndFrames ends{robot.X_WB, robot.X_TQ};
  const auto position = [&] {
    return Eigen::Vector3d(
        chain.Pose<double>(rows.q.row(0).transpose(), delta, ends).translation());
  };
  const Eigen::Vector3d before = position();
  delta.segment<6>(chain.slots().base(0)) = context.AsBaseSlots(0, twist);
  const Eigen::Vector3d p_BQ = robot.X_WB.inverse() * before;
  const Eigen::Vector3d moved_B = twist.translation + twist.rotation.cross(p_BQ - twist.at);
  EXPECT_LT((position() - before - robot.X_WB.linear() * moved_B).norm(), 1e-11);
}

TEST(PhysicsContext, ApproachDirectionComesFromTheRowBeforeOfTheSameRun) {
  RobotModel robot = LoadedRobot();
  Recording rows;
  rows.q.setZero(4, 6);
  rows.q(1, 0) = 0.1;  // joint 1 moves up, then stands, then another run starts
  rows.q(2, 0) = 0.1;
  rows.q(3, 0) = -1;
  rows.run_names = {"a", "b"};
  rows.run_idx = {0, 0, 0, 1};
  robot.joints[0].sign = -1;
  const PhysicsContext context(robot, rows, {robot.X_WB});
  EXPECT_EQ(context.direction()(0, 0), 0);
  EXPECT_EQ(context.direction()(1, 0), -1) << "in DH's sense";
  EXPECT_EQ(context.direction()(2, 0), -1) << "a joint that stands keeps its flank";
  EXPECT_EQ(context.direction()(3, 0), 0);
}

}  // namespace
}  // namespace dhcal
