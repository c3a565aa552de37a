// The chain at poses that can be worked out by hand or are printed by the robots' makers.
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/kinematics/dh_chain.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/matchers.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kPoseRounding = 1e-15;

VectorXd NoDeltas(const RobotModel& robot) { return VectorXd::Zero(5 * robot.num_joints() + 12); }

PoseWithDerivatives At(const RobotModel& robot, const VectorXd& q, const EndFrames& ends) {
  PoseWithDerivatives pose;
  DhChain(robot).PoseAndDerivatives(q, NoDeltas(robot), ends, &pose);
  return pose;
}

/// KR 15/2 in the paper's home position with the tool of 0.2 m, all else at the origin.
PoseWithDerivatives Kr15Home() {
  VectorXd q = VectorXd::Zero(6);
  q[1] = kPi / 2;
  EndFrames ends;
  ends.X_TQ.translation() = Vector3d(0, 0, 0.2);
  return At(Kr15(), q, ends);
}

TEST(Kr15Home, IsWhereItsLinksLead) {
  // Up 0.675, out 0.3; the upper arm, 0.65, and the elbow's 0.155 upwards; then 0.6 + 0.14 + 0.2
  // of forearm, wrist and tool straight out. z6 points out, x6 up.
  const PoseWithDerivatives pose = Kr15Home();
  EXPECT_THAT(pose.p_WQ, MatrixNear(Vector3d(0.3 + 0.94, 0, 0.675 + 0.65 + 0.155), kPoseRounding));
  Matrix3d R;
  R << 0, 0, 1, 0, -1, 0, 1, 0, 0;
  EXPECT_THAT(pose.R_WQ, MatrixNear(R, kPoseRounding));
}

TEST(Kr15Home, MovesAsALeverDoes) {
  const PoseWithDerivatives pose = Kr15Home();
  const SlotLayout slots(6);
  const auto theta = [&](int joint_idx) { return slots.joint(joint_idx, JointSlot::kTheta); };
  // Axis 1 is up, the point 1.24 out. Axis 2 is -y through (0.3, 0, 0.675).
  EXPECT_THAT(pose.J_p.col(theta(0)), MatrixNear(Vector3d(0, 1.24, 0), kPoseRounding));
  EXPECT_THAT(pose.J_p.col(theta(1)), MatrixNear(Vector3d(-0.805, 0, 0.94), kPoseRounding));
  EXPECT_THAT(pose.J_w.col(theta(1)), MatrixNear(Vector3d(0, -1, 0), kPoseRounding));
  // Axes 4 and 6 pass through the point: they turn it and do not move it.
  for (const int joint : {3, 5}) {
    EXPECT_THAT(pose.J_p.col(theta(joint)), MatrixNear(Vector3d(0, 0, 0), kPoseRounding));
    EXPECT_THAT(pose.J_w.col(theta(joint)), MatrixNear(Vector3d(1, 0, 0), kPoseRounding));
  }
  // d2 and d3 shift along parallel axes: what the data cannot tell apart in the paper.
  EXPECT_THAT(pose.J_p.col(slots.joint(1, JointSlot::kD)),
              MatrixNear(pose.J_p.col(slots.joint(2, JointSlot::kD)), kPoseRounding));
}

TEST(Ur10Zero, IsTheMakersZeroPosition) {
  // Arm stretched along -x: x = a2 + a3, y = -(d4 + d6), z = d1 - d5.
  const PoseWithDerivatives pose = At(Ur10(), VectorXd::Zero(6), EndFrames());
  EXPECT_THAT(pose.p_WQ, MatrixNear(Vector3d(-1.1843, -0.256141, 0.0116), kPoseRounding));
  Matrix3d R;
  R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  EXPECT_THAT(pose.R_WQ, MatrixNear(R, kPoseRounding));
}

TEST(PandaZero, IsTheMakersZeroPosition) {
  // Upright, the hand hanging down 0.088 in front: 0.333 + 0.316 + 0.384 - 0.107 = 0.926.
  EndFrames flange;
  flange.X_TQ.translation() = Vector3d(0, 0, 0.107);
  const PoseWithDerivatives pose = At(Panda(), VectorXd::Zero(7), flange);
  EXPECT_THAT(pose.p_WQ, MatrixNear(Vector3d(0.088, 0, 0.926), kPoseRounding));
  EXPECT_THAT(pose.R_WQ,
              MatrixNear(Vector3d(1, -1, -1).asDiagonal().toDenseMatrix(), kPoseRounding));
}

TEST(ScaraWithSigns, CountsJointsAgainstDenavitHartenbergsSense) {
  RobotModel robot = Scara();
  robot.joints[1].beta = 0;
  // Joint 2 at +90 deg turns by -90 deg, to -y; the slide at 0.1 retracts by 0.1 along z3 = -z.
  const PoseWithDerivatives pose = At(robot, Eigen::Vector4d(0, kPi / 2, 0.1, 0), EndFrames());
  EXPECT_THAT(pose.p_WQ,
              MatrixNear(Vector3d(0.325, -0.275, 0.387 - (0.05 - 0.1 + 0.08)), kPoseRounding));
}

TEST(ModifiedRows, DescribeTheSameRobotAsStandardOnes) {
  Rng rng(1);
  for (int i = 0; i < 10; ++i) {
    const VectorXd q = RandomJoints(Kr15(), &rng);
    const EndFrames ends{Kr15().X_WB, Kr15().X_TQ};
    const PoseWithDerivatives standard = At(Kr15(), q, ends),
                              modified = At(Kr15Modified(), q, ends);
    EXPECT_THAT(modified.p_WQ, MatrixNear(standard.p_WQ, 1e-14));
    EXPECT_THAT(modified.R_WQ, MatrixNear(standard.R_WQ, 1e-14));
  }
}

TEST(PerturbFrame, ShiftsAndTurnsInTheParentFrame) {
  const Eigen::Isometry3d X = MakeFrame({1, 2, 3}, {0, 0, kPi / 2});
  Eigen::Matrix<double, 6, 1> delta;
  delta << 0.1, 0.2, 0.3, kPi / 2, 0, 0;
  const Eigen::Isometry3d moved = PerturbFrame<double>(X, delta);
  EXPECT_THAT(moved.translation(), MatrixNear(Vector3d(1.1, 2.2, 3.3), kPoseRounding));
  // The frame's x pointed along the parent's y; a quarter turn about the parent's x lifts it to z.
  EXPECT_THAT(moved.linear().col(0), MatrixNear(Vector3d::UnitZ(), kPoseRounding));
}

TEST(IndependentKinematics, ItsModifiedRowIsCraigsInOnePiece) {
  const JointRow row = [] {
    JointRow joint;
    joint.theta = 0.3, joint.d = 0.2, joint.a = -0.1, joint.alpha = 0.7;
    return joint;
  }();
  const VectorXd none = VectorXd::Zero(5);
  EXPECT_THAT(independent::Row<double>(DhConvention::kModified, row, 0.4, none, 0),
              MatrixNear(independent::ModifiedRow<double>(0.7, 0.2, -0.1, 0.7), kPoseRounding));
}

}  // namespace
}  // namespace dhcal
