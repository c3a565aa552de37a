// Causes that act through frames, time and runs, and arms of other conventions, held to analytic
// answers.

#include "tools/proof/simulator/causes.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/matchers.h"
#include "tools/proof/simulator/arm.h"
#include "tools/proof/simulator/statics.h"
#include "tools/proof/simulator/truth.h"

namespace dhcal::concealed {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kEarth = 9.80665;

/// Two turning joints in the plane, links along x: 0.5 m and 0.3 m.
Arm Planar(Convention convention) {
  Arm arm;
  arm.convention = convention;
  arm.links.resize(2);
  if (convention == Convention::kStandard) {
    arm.links[0].a = 0.5;
    arm.links[1].a = 0.3;
  } else {
    arm.links[1].a = 0.5;
    arm.tool.translation().x() = 0.3;
  }
  return arm;
}

Motion Standing(const std::vector<Vector3d>& angles_and_time) {
  Motion motion;
  const auto rows = static_cast<Eigen::Index>(angles_and_time.size());
  motion.q.resize(rows, 2);
  motion.time.resize(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const Vector3d& row = angles_and_time[static_cast<std::size_t>(k)];
    motion.q.row(k) = row.head<2>().transpose();
    motion.time[k] = row.z();
  }
  motion.payload = VectorXd::Zero(rows);
  motion.run.assign(angles_and_time.size(), 1);
  motion.test.assign(angles_and_time.size(), false);
  return motion;
}

/// What a cause moves the tool point by, row by row.
Eigen::MatrixXd MovedBy(const Cause& cause, const Arm& arm, const Motion& motion) {
  Physics physics(arm.num_joints());
  cause.apply(&physics, 1);
  return TruePositions(arm, physics, motion) -
         TruePositions(arm, Physics(arm.num_joints()), motion);
}

TEST(Causes, AJointThatDriftsTurnsByAnExponential) {
  const Motion motion = Standing({{0, 0, 0}, {0, 0, 1000}});
  const Eigen::MatrixXd moved =
      MovedBy(JointDrifts(1, 1e-4, 1000), Planar(Convention::kStandard), motion);
  EXPECT_NEAR(moved(0, 1), 0, 1e-15);
  EXPECT_NEAR(moved(1, 1), 0.8 * 1e-4 * (1 - std::exp(-1.0)), 1e-9);
}

TEST(Causes, ABaseThatDriftsShiftsAllAlike) {
  const Motion motion = Standing({{0.3, 0.2, 0}, {1, -1, 500}});
  const Vector3d far(1e-4, 2e-4, -3e-4);
  const Eigen::MatrixXd moved =
      MovedBy(BaseDrifts(far, 500), Planar(Convention::kStandard), motion);
  EXPECT_THAT(moved.row(1).transpose(), MatrixNear(far * (1 - std::exp(-1.0)), 1e-12));
}

TEST(Causes, ABaseThatStepsTurnsAboutItself) {
  Arm arm = Planar(Convention::kStandard);
  arm.base.translation() = Vector3d(5, 0, 0);
  const Move move = {Vector3d(0, 0, 1e-3), Vector3d(0, 0, 1e-3)};
  const Eigen::MatrixXd moved =
      MovedBy(BaseSteps(1, 10, move), arm, Standing({{0, 0, 0}, {0, 0, 20}}));
  EXPECT_EQ(moved.row(0).norm(), 0);
  EXPECT_NEAR(moved(1, 1), 0.8e-3, 1e-8);
  EXPECT_NEAR(moved(1, 2), 1e-3, 1e-12);
}

TEST(Causes, ABaseThatMovesBetweenRunsStaysWithinThem) {
  Motion motion = Standing({{0, 0, 0}, {1, 0, 20}, {0, 1, 40}});
  motion.run = {1, 1, 2};
  const std::vector<Move> moves = {{Vector3d::Zero(), Vector3d::Zero()},
                                   {Vector3d(1e-3, 0, 0), Vector3d::Zero()}};
  const Eigen::MatrixXd moved =
      MovedBy(BaseMovesBetweenRuns(moves), Planar(Convention::kStandard), motion);
  EXPECT_EQ(moved.topRows(2).norm(), 0);
  EXPECT_NEAR(moved(2, 0), 1e-3, 1e-15);
}

TEST(Causes, AnUnsettledJointLacksAPartOfItsMove) {
  const Eigen::MatrixXd moved =
      MovedBy(NotSettled(1e-3), Planar(Convention::kStandard), Standing({{0, 0, 0}, {0.4, 0, 20}}));
  EXPECT_EQ(moved.row(0).norm(), 0);
  EXPECT_NEAR(moved.row(1).norm(), 0.8 * 1e-3 * 0.4, 1e-9);
}

TEST(Causes, ABearingTiltsItsAxisTwicePerTurn) {
  // Arm along x, tilt about y by w sin(2 q): it rises or falls by 0.8 m times that.
  const double w = 1e-4, q = 0.7;
  const Arm arm = Planar(Convention::kStandard);
  const Eigen::MatrixXd moved = MovedBy(Wobbles(1, w, 0), arm, Standing({{q, 0, 0}}));
  const Vector3d tilt(w * std::cos(2 * q), w * std::sin(2 * q), 0);
  const Vector3d p(0.8 * std::cos(q), 0.8 * std::sin(q), 0);
  EXPECT_THAT(moved.row(0).transpose(), MatrixNear(tilt.cross(p), 1e-8));
}

TEST(Causes, ASlotThatFollowsSomethingMovesByItsCourse) {
  const Motion motion = Standing({{0, 0, 0}, {0, 0, 20}});
  const Eigen::Vector2d course(-1, 0.5);
  const auto moved = [&](const std::string& slot) {
    return MovedBy(
        Follows("motor_temp", slot, course, 1e-4), Planar(Convention::kStandard), motion);
  };
  EXPECT_NEAR(moved("theta1")(1, 1), 0.8 * 0.5e-4, 1e-9);
  EXPECT_NEAR(moved("alpha1")(0, 2), 0, 1e-9) << "along its own x";
  EXPECT_NEAR(moved("a2")(0, 0), -1e-4, 1e-12);
  EXPECT_NEAR(moved("d1")(1, 2), 0.5e-4, 1e-12);
  EXPECT_NEAR(moved("base_y")(0, 1), -1e-4, 1e-12);
  EXPECT_NEAR(moved("tool_z")(1, 2), 0.5e-4, 1e-12);
}

TEST(Causes, ALinkGrowsAlikeInBothConventions) {
  // The link between the joints: row 1 of standard rows, row 2 of modified ones.
  Motion motion = Standing({{0.3, 0.9, 1e9}});
  const Eigen::MatrixXd standard =
      MovedBy(FirstLinkGrows(1e-4, 10), Planar(Convention::kStandard), motion);
  const Eigen::MatrixXd modified =
      MovedBy(SecondLinkGrows(1e-4, 10), Planar(Convention::kModified), motion);
  EXPECT_THAT(standard, MatrixNear(modified, 1e-12));
  EXPECT_NEAR(standard.norm(), 0.5e-4, 1e-9);
}

TEST(Causes, ALinkBendsAlikeInBothConventions) {
  // Turned on its side, with a weight at the tool: link 1 carries it.
  for (const Convention convention : {Convention::kStandard, Convention::kModified}) {
    Arm arm = Planar(convention);
    arm.links[0].alpha += convention == Convention::kModified ? -kPi / 2 : 0;
    arm.payload_com.x() = convention == Convention::kModified ? 0.3 : 0;
    if (convention == Convention::kStandard) {
      arm.links.insert(arm.links.begin(), DrawnLink());
      arm.links[0].alpha = -kPi / 2;
    }
    const int link = convention == Convention::kStandard ? 2 : 1;
    Motion motion = Standing({{0, 0, 0}});
    if (convention == Convention::kStandard) motion.q = Eigen::MatrixXd::Zero(1, 3);
    motion.payload[0] = 10;
    const double bend = 1e-7, force = 10 * kEarth, L = 0.5, arm_beyond = 0.3;
    const double moment = force * arm_beyond;
    const double slope = bend * (force * L * L / 2 + moment * L);
    const double sag = bend * (force * L * L * L / 3 + moment * L * L / 2) + slope * arm_beyond;
    const Eigen::MatrixXd moved = MovedBy(LinkBends(link, bend), arm, motion);
    EXPECT_NEAR(moved(0, 2) / -sag, 1, 1e-3);
  }
}

TEST(Slides, CarryTheWeightAlongTheirAxis) {
  Arm arm;
  arm.links.resize(1);
  arm.links[0].slides = true;
  arm.links[0].mass = 3;
  const ScrewArm screws(arm);
  const VectorXd q = VectorXd::Constant(1, 0.4);
  EXPECT_NEAR(RigidTorques(arm, screws, q, 0)[0], -3 * kEarth, 1e-12);
  Motion motion;
  motion.q = q.transpose();
  motion.time = motion.payload = VectorXd::Zero(1);
  motion.run = {1};
  EXPECT_NEAR(TruePositions(arm, Physics(1), motion)(0, 2), 0.4, 1e-15);
}

TEST(Friction, GrowsWhereTheAngleSaysSo) {
  Physics physics(2);
  RubsByAngle(2, 1e-4, 1, 0).apply(&physics, 1);
  const Motion motion = Standing({{0, -1, 0}, {0, 0, 20}, {0, kPi / 2, 40}});
  const Eigen::MatrixXd lost = LostMotion(Planar(Convention::kStandard), physics, motion);
  EXPECT_NEAR(lost(1, 1), -1e-4, 1e-12);
  EXPECT_NEAR(lost(2, 1), -2e-4, 1e-12);
}

TEST(Cables, PullOnlyBeyondTheirSlack) {
  Physics physics(2);
  CableTautens(1, 1, 2, 0.5, 1e-3).apply(&physics, 1);
  const VectorXd slack = Eigen::Vector2d(0.2, 0.1), taut = Eigen::Vector2d(0.5, 0.4);
  EXPECT_EQ(physics.cross(0, slack), 0);
  EXPECT_NEAR(physics.cross(0, taut), 0.4e-3, 1e-15);
  EXPECT_EQ(physics.cross(1, taut), 0);
}

}  // namespace
}  // namespace dhcal::concealed
