#include "problems/formats/problem/robot_reader.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/kinematics/dh_chain.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/result/result_writer.h"
#include "tests/support/temp_file.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

/// The robot of a problem with this section `robot`; its messages.
RobotModel ReadRobotOf(const std::string& section, std::string* messages = nullptr) {
  const TempFile file(
      "schema: 1\nrobot:\n" + section +
          "measurement: {kind: position}\nsimulate: {motion: {kind: random, poses: 3}}\n",
      ".yaml");
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(file.path(), "", &diagnostics);
  if (messages != nullptr) *messages = diagnostics.ToString();
  if (messages == nullptr) {
    EXPECT_EQ(diagnostics.ToString(), "");
  }
  return spec ? spec->robot : RobotModel();
}

Eigen::Isometry3d PoseOfTool(const RobotModel& robot, const Eigen::VectorXd& q) {
  const DhChain chain(robot);
  return chain.Pose<double>(
      q, Eigen::VectorXd::Zero(chain.slots().size()), {robot.X_WB, robot.X_TQ});
}

TEST(RobotReader, FixedRowsBecomePartOfBaseAndTool) {
  for (const std::string convention : {"standard", "modified"}) {
    const std::string rows =
        "    - {name: foot, TYPE, theta_deg: 20, d_m: 0.3, a_m: 0.1, alpha_deg: -15}\n"
        "    - {d_m: 0.4, alpha_deg: 90}\n"
        "    - {a_m: 0.5, alpha_deg: -30}\n"
        "    - {name: flange, TYPE, theta_deg: 45, d_m: 0.107, a_m: 0.088, alpha_deg: 90}\n"
        "  base: {xyz_m: [1, 2, 3], rpy_deg: [10, 20, 30]}\n"
        "  tool: {xyz_m: [0.01, 0.02, 0.1], rpy_deg: [5, 0, 0]}\n";
    const auto with_type = [&](const std::string& type) {
      std::string text = "  convention: " + convention + "\n  joints:\n" + rows;
      for (std::size_t at = 0; (at = text.find("TYPE", at)) != std::string::npos;) {
        text.replace(at, 4, "type: " + type);
      }
      return text;
    };
    const RobotModel fixed = ReadRobotOf(with_type("fixed"));
    const RobotModel turning = ReadRobotOf(with_type("revolute"));
    ASSERT_EQ(fixed.num_joints(), 2);
    EXPECT_EQ(fixed.joints[0].name, "J1");
    const Eigen::Isometry3d X = PoseOfTool(fixed, Eigen::Vector2d(0.3, -0.8));
    const Eigen::Isometry3d expected = PoseOfTool(turning, Eigen::Vector4d(0, 0.3, -0.8, 0));
    EXPECT_TRUE(X.isApprox(expected, 1e-14)) << convention;
  }
}

TEST(RobotReader, FixedRowsAreGoneFromTheCalibratedFile) {
  const TempFile file(
      "schema: 1\n"
      "robot:\n"
      "  joints:\n"
      "    - {type: fixed, alpha_deg: 90}\n"
      "    - {d_m: 0.4, alpha_deg: 90}\n"
      "    - {a_m: 0.5}\n"
      "    - {type: fixed, d_m: 0.1}\n"
      "  payload: {mass_kg: 2, com_m: [0, 0, 0.05]}\n"
      "measurement: {kind: position}\n"
      "recording: rows.csv\n",
      ".yaml");
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(file.path(), "", &diagnostics);
  ASSERT_TRUE(spec.has_value()) << diagnostics.ToString();
  const TempFile written(CalibratedYaml(*spec, spec->robot, {}, "rows.csv"), "_calibrated.yaml");
  const auto again = ReadProblemFile(written.path(), "", &diagnostics);
  ASSERT_TRUE(again.has_value()) << diagnostics.ToString();
  const Eigen::Vector2d q(0.3, -0.8);
  EXPECT_TRUE(PoseOfTool(again->robot, q).isApprox(PoseOfTool(spec->robot, q), 1e-14));
  EXPECT_TRUE(again->robot.gravity_B.isApprox(spec->robot.gravity_B, 1e-14));
  EXPECT_NEAR(spec->robot.gravity_B.y(), -9.80665, 1e-12);
  EXPECT_NEAR(spec->robot.payload.p_LC.z(), 0.15, 1e-15);
  EXPECT_TRUE(again->robot.payload.p_LC.isApprox(spec->robot.payload.p_LC, 1e-14));
}

TEST(RobotReader, FixedRowBetweenJointsIsRefused) {
  std::string messages;
  ReadRobotOf("  joints:\n    - {a_m: 1}\n    - {type: fixed, d_m: 1}\n    - {a_m: 1}\n",
              &messages);
  EXPECT_THAT(messages, HasSubstr(":5:7: error: 'robot.joints[2]' is a fixed row between joints"));
  ReadRobotOf("  joints:\n    - {type: fixed, d_m: 1}\n", &messages);
  EXPECT_THAT(messages, HasSubstr("has fixed rows only"));
}

TEST(RobotReader, AnglesInRadiansMayBeWrittenWithPi) {
  const RobotModel robot =
      ReadRobotOf("  joints:\n    - {alpha_rad: -pi/2, theta_rad: 3*pi/4, d_m: 1}\n");
  EXPECT_DOUBLE_EQ(robot.joints[0].alpha, -kPi / 2);
  EXPECT_DOUBLE_EQ(robot.joints[0].theta, 3 * kPi / 4);
}

TEST(RobotReader, PiInDegreesIsRefusedWithTheCure) {
  std::string messages;
  ReadRobotOf("  joints:\n    - {alpha_deg: pi/2}\n", &messages);
  EXPECT_THAT(messages,
              HasSubstr("is 'pi/2', but a number of degrees is expected; write 90, or end the key "
                        "in _rad"));
}

}  // namespace
}  // namespace dhcal
