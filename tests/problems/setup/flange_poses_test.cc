#include "problems/setup/flange_poses.h"

#include <vector>

#include <gtest/gtest.h>

#include "problems/setup/cause.h"
#include "residuals/registry.h"
#include "tests/support/set_up_files.h"

namespace dhcal {
namespace {

// GoogleTest has a member of the name.
using TakenAs = SetUp;

/// A set-up with something of every kind that changes the arm.
TakenAs RandomSetUp(const RobotModel& robot, Rng* rng) {
  const auto chance = [&] { return rng->Uniform(0, 1) < 0.4; };
  const int n = robot.num_joints();
  TakenAs set_up = AsWritten(n);
  for (int j = 0; j < n; ++j) {
    const bool turns = robot.joints[static_cast<std::size_t>(j)].type == JointType::kRevolute;
    TakenAs::Joint& joint = set_up.joints[static_cast<std::size_t>(j)];
    if (chance()) joint.sense = -1;
    if (turns && chance()) joint.quarters = 2;
    if (turns && chance()) joint.unit = AngleUnit::kHoldsDegrees;
  }
  set_up.other_convention = chance();
  if (chance()) set_up.table_scale = 1e-3;
  if (robot.joints[0].type == robot.joints[1].type) {
    std::swap(set_up.joints[0].column, set_up.joints[1].column);
    if (robot.joints[1].type == JointType::kRevolute) {
      set_up.joints[1].driver = 0;
      set_up.joints[1].driver_factor = -1;
    }
  }
  return set_up;
}

TEST(FlangeOfRows, IsTheFlangeOfTheCuredFiles) {
  Rng rng(7);
  for (const TestRobot& robot : TestRobots()) {
    SCOPED_TRACE(robot.model.name);
    const ProblemSpec spec = ProblemOf(robot.model, KindNamed("position"));
    const Recording recording = RecordingOfRobot(robot.model, 5, 0, &rng);
    const TakenAs set_up = RandomSetUp(robot.model, &rng);
    FlangePoses poses;
    FlangeOfRows(spec.robot, recording, {0, 3}).Evaluate(set_up, &poses);

    CuredFiles cured = Cured({spec, recording}, set_up);
    for (int k = 0; k < 2; ++k) {
      const Eigen::VectorXd q = cured.recording.q.row(3 * k).transpose();
      RobotModel turned = cured.spec.robot;
      // The cure of a coupling is an effect; here it is put into the angle by hand.
      if (set_up.joints[1].driver >= 0) turned.joints[1].theta -= q[0];
      const independent::Vector<double> zero = independent::Vector<double>::Zero(5 * q.size() + 12);
      const Eigen::Matrix4d X = independent::ForwardKinematics<double>(
          turned, q, zero, Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity());
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(poses.p[i][k], X(static_cast<int>(i), 3), 1e-12);
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(poses.R[c][i][k], X(static_cast<int>(i), static_cast<int>(c)), 1e-12);
        }
      }
    }
  }
}

}  // namespace
}  // namespace dhcal
