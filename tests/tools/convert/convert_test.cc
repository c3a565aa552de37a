// dhcal_convert from each form into each other: judged by kinematics written apart, at poses that
// no conversion knows.
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/base/rng.h"
#include "problems/formats/problem/robot_file.h"
#include "tests/support/comma_locale.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/robots.h"
#include "tests/support/temp_folder.h"
#include "tests/support/urdf_robots.h"
#include "tests/support/urdf_walk.h"
#include "tools/convert/run.h"

namespace dhcal {
namespace {

using Eigen::Matrix4d;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::Not;

constexpr double kTolerance = 1e-12;  // [m] and [rad]

/// Rows of Universal Robots' data sheet for the UR10.
constexpr char kUr10[] = R"(schema: 1
robot:
  joints:
    - {name: shoulder_pan_joint, d_m: 0.1273, alpha_rad: pi/2}
    - {name: shoulder_lift_joint, a_m: -0.612}
    - {name: elbow_joint, a_m: -0.5723}
    - {name: wrist_1_joint, d_m: 0.163941, alpha_rad: pi/2}
    - {name: wrist_2_joint, d_m: 0.1157, alpha_rad: -pi/2}
    - {name: wrist_3_joint, d_m: 0.0922}
)";

/// A factory calibration: axes 2 and 3 not quite parallel, so that their common normal is far away.
constexpr char kCalibration[] = R"([mounting]
calibration_status = 0 # linear
delta_theta = [ -1.3e-07, 0.35, 5.97, -0.04, 1.2e-06, -3e-07 ]
delta_a = [ 5.7e-05, 0.211, 0.0024, 5.7e-05, -4.7e-05, 0.0 ]
delta_d = [ 4.9e-05, 286.37, -294.1, 7.74, 1e-05, -2e-05 ]
delta_alpha = [ 4.4e-04, 1.2e-03, -1.8e-03, 3.6e-04, -7e-05, 0.0 ]
joint_checksum = [ 0x1, 0x2, 0x3, 0x4, 0x5, 0x6 ]
)";

class ConvertTest : public testing::Test {
 protected:
  /// Runs with `options` whose files are names in the folder.
  int Run(ConvertOptions options) {
    for (std::string* file : {&options.from, &options.to, &options.urdf, &options.nominal}) {
      if (!file->empty()) *file = folder_ / *file;
    }
    std::ostringstream messages;
    const int status = RunConvert(options, messages);
    said_ = messages.str();
    return status;
  }
  RobotModel Robot(const std::string& name) {
    Diagnostics diagnostics;
    const auto file = ReadRobotFile(folder_ / name, "", &diagnostics);
    EXPECT_TRUE(file) << diagnostics.ToString();
    return file ? file->robot : RobotModel();
  }
  std::string Text(const std::string& name) const { return ReadFile(folder_.path() / name); }
  bool Exists(const std::string& name) const { return NamesIn(folder_.path()).count(name) > 0; }

  TempFolder folder_;
  std::string said_;
};

Matrix4d Forward(const RobotModel& robot, const VectorXd& q) {
  return independent::ForwardKinematics<double>(robot, q, VectorXd::Zero(5 * q.size() + 12));
}

double LargestDifference(const RobotModel& one, const RobotModel& other) {
  if (one.num_joints() == 0 || one.num_joints() != other.num_joints()) return HUGE_VAL;
  Rng rng(4);
  double largest = 0;
  for (int k = 0; k < 10; ++k) {
    const VectorXd q = RandomJoints(one, &rng);
    largest = std::max(largest, (Forward(one, q) - Forward(other, q)).cwiseAbs().maxCoeff());
  }
  return largest;
}

double LargestDifference(const RobotModel& rows,
                         const UrdfRobot& urdf,
                         const std::string& text,
                         const std::string& base,
                         const std::string& tip) {
  const UrdfWalk walk(text);
  Rng rng(5);
  double largest = 0;
  for (int k = 0; k < 10; ++k) {
    const VectorXd q = RandomJoints(rows, &rng);
    UrdfWalk::Coordinates named;
    for (std::size_t j = 0; j < urdf.joints.size(); ++j) {
      named[urdf.joints[j]] = q[static_cast<Eigen::Index>(j)];
    }
    largest =
        std::max(largest, (walk.Pose(base, tip, named) - Forward(rows, q)).cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST_F(ConvertTest, UrdfToRowsOfBothConventionsAndBackMovesAlike) {
  for (const UrdfRobot& urdf : AllUrdfs()) {
    WriteFile(folder_ / "arm.urdf", urdf.text);
    for (const std::string convention : {"standard", "modified"}) {
      ConvertOptions options;
      options.from = "arm.urdf";
      options.base_link = urdf.base_link;
      options.tip_link = urdf.tip_link;
      options.convention = convention;
      options.to = convention + ".yaml";
      ASSERT_EQ(Run(options), kConvertOk) << said_;
      EXPECT_LT(
          LargestDifference(Robot(options.to), urdf, urdf.text, urdf.base_link, urdf.tip_link),
          kTolerance)
          << urdf.name;
    }
    ConvertOptions back;
    back.from = "modified.yaml";
    back.to = "back.urdf";
    ASSERT_EQ(Run(back), kConvertOk) << said_;
    const std::string text = Text("back.urdf");
    const bool world = text.find("\"world\"") != std::string::npos;
    EXPECT_LT(LargestDifference(
                  Robot("modified.yaml"), urdf, text, world ? "world" : "base_link", "tool0"),
              kTolerance)
        << urdf.name;
  }
}

TEST_F(ConvertTest, StandardRowsToModifiedOnesAndBackMoveAlike) {
  for (const TestRobot& robot : TestRobots()) {
    WriteFile(folder_ / "a.yaml", RobotFileText(robot.model, "a", {}));
    ConvertOptions options;
    options.from = "a.yaml";
    options.to = "b.yaml";
    options.convention =
        robot.model.convention == DhConvention::kStandard ? "modified" : "standard";
    ASSERT_EQ(Run(options), kConvertOk) << said_;
    EXPECT_NE(Robot("b.yaml").convention, robot.model.convention);
    EXPECT_LT(LargestDifference(robot.model, Robot("b.yaml")), kTolerance) << robot;
  }
}

TEST_F(ConvertTest, FactoryCalibrationIsAddedToTheRowsAndKeepsNormalsNear) {
  WriteFile(folder_ / "ur10.yaml", kUr10);
  WriteFile(folder_ / "calibration.conf", kCalibration);
  ConvertOptions options;
  options.from = "calibration.conf";
  options.nominal = "ur10.yaml";
  options.to = "calibrated.yaml";
  ASSERT_EQ(Run(options), kConvertOk) << said_;
  // The sum as the controller has it.
  RobotModel sum = Robot("ur10.yaml");
  const double deltas[6][4] = {{-1.3e-07, 4.9e-05, 5.7e-05, 4.4e-04},
                               {0.35, 286.37, 0.211, 1.2e-03},
                               {5.97, -294.1, 0.0024, -1.8e-03},
                               {-0.04, 7.74, 5.7e-05, 3.6e-04},
                               {1.2e-06, 1e-05, -4.7e-05, -7e-05},
                               {-3e-07, -2e-05, 0, 0}};
  for (std::size_t j = 0; j < 6; ++j) {
    sum.joints[j].theta += deltas[j][0];
    sum.joints[j].d += deltas[j][1];
    sum.joints[j].a += deltas[j][2];
    sum.joints[j].alpha += deltas[j][3];
  }
  const RobotModel read = Robot("calibrated.yaml");
  EXPECT_LT(LargestDifference(sum, read), kTolerance);
  for (const JointRow& row : read.joints) EXPECT_LT(std::abs(row.d), 10) << row.name;
  // The same where a problem file names it.
  WriteFile(folder_ / "named.yaml", std::string(kUr10) + "  calibration_conf: calibration.conf\n");
  EXPECT_LT(LargestDifference(Robot("named.yaml"), read), kTolerance);
}

/// Numbers of ur_description's config/ur10/default_kinematics.yaml.
TEST_F(ConvertTest, TheDataSheetIsRosKinematicsOfUrDescription) {
  WriteFile(folder_ / "ur10.yaml", kUr10);
  ConvertOptions options;
  options.from = "ur10.yaml";
  options.to = "kinematics.yaml";
  options.kind = "ros_kinematics";
  options.hash = "calib_123";
  ASSERT_EQ(Run(options), kConvertOk) << said_;
  const YAML::Node file = YAML::Load(Text("kinematics.yaml"))["kinematics"];
  const struct {
    const char* link;
    double x, y, z, roll;
  } expected[] = {{"shoulder", 0, 0, 0.1273, 0},
                  {"upper_arm", 0, 0, 0, 1.570796327},
                  {"forearm", -0.612, 0, 0, 0},
                  {"wrist_1", -0.5723, 0, 0.163941, 0},
                  {"wrist_2", 0, -0.1157, 0, 1.570796327}};
  for (const auto& link : expected) {
    EXPECT_NEAR(file[link.link]["x"].as<double>(), link.x, 1e-9) << link.link;
    EXPECT_NEAR(file[link.link]["y"].as<double>(), link.y, 1e-9) << link.link;
    EXPECT_NEAR(file[link.link]["z"].as<double>(), link.z, 1e-9) << link.link;
    EXPECT_NEAR(file[link.link]["roll"].as<double>(), link.roll, 1e-9) << link.link;
  }
  EXPECT_EQ(file["hash"].as<std::string>(), "calib_123");
  ConvertOptions back;
  back.from = "kinematics.yaml";
  back.to = "back.yaml";
  ASSERT_EQ(Run(back), kConvertOk) << said_;
  EXPECT_LT(LargestDifference(Robot("ur10.yaml"), Robot("back.yaml")), kTolerance);
}

/// Rounding leaves no traces in what people read.
TEST_F(ConvertTest, TheDataSheetComesBackFromAUrdfDigitForDigit) {
  WriteFile(folder_ / "ur10.yaml", kUr10);
  ConvertOptions options;
  options.from = "ur10.yaml";
  options.to = "ur10.urdf";
  ASSERT_EQ(Run(options), kConvertOk) << said_;
  options.from = "ur10.urdf";
  options.to = "back.yaml";
  ASSERT_EQ(Run(options), kConvertOk) << said_;
  const RobotModel sheet = Robot("ur10.yaml"), back = Robot("back.yaml");
  for (std::size_t j = 0; j < sheet.joints.size(); ++j) {
    EXPECT_EQ(back.joints[j].a, sheet.joints[j].a) << j;
    EXPECT_EQ(back.joints[j].d, sheet.joints[j].d) << j;
    EXPECT_EQ(back.joints[j].theta, 0) << j;
    EXPECT_NEAR(back.joints[j].alpha, sheet.joints[j].alpha, 1e-15) << j;
  }
  EXPECT_TRUE(back.X_TQ.isApprox(Eigen::Isometry3d::Identity(), 0));
  EXPECT_THAT(Text("back.yaml"), Not(HasSubstr("tool:")));
}

TEST_F(ConvertTest, CorrectionsGoIntoTheUrdfThatTheRowsComeFrom) {
  const UrdfRobot urdf = PublishedUrdfs()[2];
  WriteFile(folder_ / "arm.urdf", urdf.text);
  WriteFile(folder_ / "problem.yaml",
            "schema: 1\nrobot: {urdf: arm.urdf, base_link: panda_link0, tip_link: panda_link8}\n");
  RobotModel calibrated = Robot("problem.yaml");
  for (JointRow& row : calibrated.joints) row.theta += 1e-3;
  WriteFile(folder_ / "calibrated.yaml",
            RobotFileText(calibrated, "c", {}) +
                "parameters: {effects: [{effect: joint_compliance, joint: 2}]}\n");
  ConvertOptions options;
  options.from = "calibrated.yaml";
  options.urdf = "arm.urdf";
  options.tip_link = "panda_link8";
  options.to = "out.urdf";
  ASSERT_EQ(Run(options), kConvertOk) << said_;
  EXPECT_THAT(said_, HasSubstr("not in it: joint_compliance of joint 2"));
  EXPECT_THAT(Text("out.urdf"), HasSubstr("joint_compliance of joint 2"));
  EXPECT_LT(LargestDifference(calibrated, urdf, Text("out.urdf"), urdf.base_link, urdf.tip_link),
            kTolerance);
  // Without --urdf a file of the rows alone.
  options.urdf.clear();
  ASSERT_EQ(Run(options), kConvertOk) << said_;
  EXPECT_THAT(Text("out.urdf"), Not(HasSubstr("package://")));
}

TEST_F(ConvertTest, WritesTheSameUnderACommaLocale) {
  WriteFile(folder_ / "ur10.yaml", kUr10);
  ConvertOptions options;
  options.from = "ur10.yaml";
  options.to = "comma.urdf";
  {
    const CommaLocale comma;
    ASSERT_EQ(Run(options), kConvertOk) << said_;
  }
  options.to = "plain.urdf";
  ASSERT_EQ(Run(options), kConvertOk) << said_;
  EXPECT_EQ(Text("plain.urdf"), Text("comma.urdf"));
}

TEST_F(ConvertTest, WhatCannotBeDoneIsSaidAndLeavesNoFile) {
  WriteFile(folder_ / "ur10.yaml", kUr10);
  WriteFile(folder_ / "calibration.conf", kCalibration);
  WriteFile(folder_ / "short.conf",
            "[mounting]\ndelta_theta = [1, 2]\ndelta_a = [1, x]\ndelta_d = 3\n");
  WriteFile(folder_ / "arm.urdf", PublishedUrdfs()[3].text);
  const struct {
    std::string from, to, kind, nominal, said;
  } wrong[] = {
      {"", "out.yaml", "", "", "--from: error: is missing"},
      {"ur10.yaml", "out.conf", "", "", "only with its own checksums"},
      {"ur10.yaml", "out.txt", "", "", "say what it shall be with --kind"},
      {"ur10.yaml", "out.yaml", "dh", "", "--kind: error: is 'dh'"},
      {"calibration.conf", "out.yaml", "", "", "give those with --nominal robot.yaml"},
      {"short.conf", "out.yaml", "", "ur10.yaml", "short.conf:3:15: error: 'x' is no number"},
      {"short.conf", "out.yaml", "", "ur10.yaml", "short.conf:4:11: error: 'delta_d' is no list"},
      {"short.conf", "out.yaml", "", "ur10.yaml", "has no 'delta_alpha'"},
      {"arm.urdf", "out.yaml", "ros_kinematics", "", "has 4 joints, but a kinematics_params_file"},
      {"none.urdf", "out.yaml", "", "", "none.urdf"},
      {"ur10.yaml", "ur10.yaml", "", "", "is the file that is read"}};
  for (const auto& k : wrong) {
    ConvertOptions options;
    options.from = k.from;
    options.to = k.to;
    options.kind = k.kind;
    options.nominal = k.nominal;
    EXPECT_EQ(Run(options), kConvertBadInput) << k.said;
    EXPECT_THAT(said_, HasSubstr(k.said));
    EXPECT_FALSE(Exists("out.yaml"));
    EXPECT_FALSE(Exists("out.conf"));
  }
  EXPECT_EQ(Text("ur10.yaml"), kUr10);
}

}  // namespace
}  // namespace dhcal
