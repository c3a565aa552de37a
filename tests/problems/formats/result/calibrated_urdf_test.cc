// A robot from a URDF is calibrated on a recording of one with known errors: the URDF written
// beside calibrated.yaml moves as the true robot does.
#include <filesystem>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "problems/diagnosis/calibrate.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/problem/robot_file.h"
#include "problems/formats/result/result_writer.h"
#include "problems/simulate.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/robots.h"
#include "tests/support/temp_folder.h"
#include "tests/support/urdf_robots.h"
#include "tests/support/urdf_walk.h"

namespace dhcal {
namespace {

using Eigen::Matrix4d;
using Eigen::VectorXd;
using testing::HasSubstr;

constexpr char kUrdfProblem[] = R"(schema: 1
name: ur
robot:
  urdf: arm.urdf
  base_link: base_link
  tip_link: tool0
  base: {xyz_mm: [1200, -300, 50], rpy_deg: [0, 0, 20]}
  tool: {xyz_mm: [20, 30, 150]}
measurement: {kind: pose, sigma_mm: 0.01, sigma_rotation_mrad: 0.01}
diagnosis: {run: never}
parameters: {estimate: [theta, d, a, alpha, beta2, beta3], fix: [d2, d3]}
simulate:
  motion: {kind: random, poses: 60, min_deg: [-100, -100, -100, -100, -100, -100],
           max_deg: [100, 100, 100, 100, 100, 100]}
  errors: {theta_rad: [1e-3, -2e-3, 1.5e-3, 1e-3, 2e-3, -1e-3], a_m: [1e-4, 3e-4, -2e-4, 1e-4, 1e-4, 0],
           d_m: [2e-4, 0, 0, 1e-4, 1e-4, 3e-4], alpha_rad: [5e-4, 2e-4, -3e-4, 1e-4, 2e-4, 0],
           beta_rad: [0, 3e-4, 1e-4, 0, 0, 0]}
  effects: []
)";

class CalibratedUrdfTest : public testing::Test {
 protected:
  std::optional<ProblemSpec> Read(const std::string& problem) {
    WriteFile(folder_ / "problem.yaml", problem);
    return ReadProblemFile(folder_ / "problem.yaml", "", &diagnostics_);
  }

  TempFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(CalibratedUrdfTest, MovesAsTheTrueRobotDoes) {
  const UrdfRobot urdf = PublishedUrdfs().front();
  WriteFile(folder_ / "arm.urdf", urdf.text);
  const std::optional<ProblemSpec> spec = Read(kUrdfProblem);
  ASSERT_TRUE(spec) << diagnostics_.ToString();
  const std::optional<Recording> recording = SimulateRecording(*spec, &diagnostics_);
  ASSERT_TRUE(recording) << diagnostics_.ToString();
  const Result result = Calibrate(*spec, *recording, {});
  ASSERT_NE(result.best(), nullptr);
  ASSERT_TRUE(WriteResult(*spec, *recording, result, folder_ / "out", &diagnostics_))
      << diagnostics_.ToString();
  EXPECT_EQ(diagnostics_.ToString(), "");

  RobotModel truth = spec->robot;
  const SimulationSpec& errors = *spec->simulate;
  for (std::size_t j = 0; j < truth.joints.size(); ++j) {
    const auto idx = static_cast<Eigen::Index>(j);
    truth.joints[j].theta += errors.row_errors(JointSlot::kTheta)[idx];
    truth.joints[j].d += errors.row_errors(JointSlot::kD)[idx];
    truth.joints[j].a += errors.row_errors(JointSlot::kA)[idx];
    truth.joints[j].alpha += errors.row_errors(JointSlot::kAlpha)[idx];
    truth.joints[j].beta += errors.row_errors(JointSlot::kBeta)[idx];
  }
  const auto calibrated = ReadRobotFile(folder_ / "out/calibrated.yaml", "", &diagnostics_);
  ASSERT_TRUE(calibrated) << diagnostics_.ToString();
  EXPECT_FALSE(calibrated->urdf);
  const UrdfWalk walk(ReadFile(folder_.path() / "out/calibrated.urdf"));
  // What stands still on the last link: its error of a and alpha is the tool's.
  std::optional<Matrix4d> X_EQ;
  Rng rng(3);
  for (int k = 0; k < 10; ++k) {
    const VectorXd q = RandomJoints(truth, &rng), none = VectorXd::Zero(5 * q.size() + 12);
    UrdfWalk::Coordinates named;
    for (std::size_t j = 0; j < urdf.joints.size(); ++j) {
      named[urdf.joints[j]] = q[static_cast<Eigen::Index>(j)];
    }
    const Matrix4d X_WQ = independent::ForwardKinematics<double>(truth, q, none);
    const Matrix4d X_WQ_calibrated =
        independent::ForwardKinematics<double>(calibrated->robot, q, none);
    EXPECT_LT((X_WQ - X_WQ_calibrated).cwiseAbs().maxCoeff(), 1e-8);
    const Matrix4d X_AE = walk.Pose("base_link", "tool0", named);
    const Matrix4d X_AQ = (Eigen::Translation3d(1.2, -0.3, 0.05) *
                           Eigen::AngleAxisd(20 * kDegree, Eigen::Vector3d::UnitZ()))
                              .inverse()
                              .matrix() *
                          X_WQ_calibrated;
    if (!X_EQ) X_EQ = X_AE.inverse() * X_AQ;
    EXPECT_LT((X_AE * *X_EQ - X_AQ).cwiseAbs().maxCoeff(), 1e-12);
  }
  EXPECT_LT((X_EQ->topRightCorner<3, 1>() - Eigen::Vector3d(0.02, 0.03, 0.15)).norm(), 1e-3);
}

TEST_F(CalibratedUrdfTest, IsNotWrittenWithoutAUrdf) {
  const std::optional<ProblemSpec> spec = Read(R"(schema: 1
robot: {joints: [{a_m: 0.3, alpha_deg: 90}, {a_m: 0.2}]}
measurement: {kind: position}
simulate: {motion: {kind: random, poses: 30}}
)");
  ASSERT_TRUE(spec) << diagnostics_.ToString();
  EXPECT_EQ(CalibratedUrdf(*spec, {}, &diagnostics_), "");
  EXPECT_TRUE(diagnostics_.ok());
}

TEST_F(CalibratedUrdfTest, NamesTheEffectsThatItCannotHold) {
  WriteFile(folder_ / "arm.urdf", PublishedUrdfs().front().text);
  const std::optional<ProblemSpec> spec = Read(kUrdfProblem);
  ASSERT_TRUE(spec) << diagnostics_.ToString();
  Result result;
  result.delivered.emplace();
  result.delivered->robot = spec->robot;
  EffectRequest effect;
  effect.effect = "joint_gain";
  effect.joint = 3;
  effect.values = {{"gain", 2e-4}};
  result.delivered->effects = {effect};
  const std::string text = CalibratedUrdf(*spec, result, &diagnostics_);
  EXPECT_THAT(text, HasSubstr("no URDF can hold"));
  EXPECT_THAT(text, HasSubstr("joint_gain at joint 3 (gain 0.0002, SI units)"));
  // Rows of no such robot: no file, and a warning.
  result.delivered->robot.joints[1].a += 1;
  EXPECT_EQ(CalibratedUrdf(*spec, result, &diagnostics_), "");
  EXPECT_TRUE(diagnostics_.ok());
  EXPECT_THAT(diagnostics_.ToString(), HasSubstr("warning: no calibrated.urdf is written"));
}

TEST_F(CalibratedUrdfTest, WhatStandsBesideAUrdfIsRefused) {
  WriteFile(folder_ / "arm.urdf", PublishedUrdfs().front().text);
  EXPECT_FALSE(Read(R"(schema: 1
robot:
  urdf: arm.urdf
  tip_link: tool1
  joints: [{a_m: 1}]
measurement: {kind: position}
recording: r.csv
)"));
  EXPECT_THAT(diagnostics_.ToString(),
              HasSubstr("problem.yaml:4:13: error: " + (folder_ / "arm.urdf") +
                        " has no link 'tool1'; did you mean 'tool0'?"));
  EXPECT_THAT(diagnostics_.ToString(),
              HasSubstr("problem.yaml:5:11: error: 'robot.joints' stands beside 'robot.urdf'"));
}

TEST_F(CalibratedUrdfTest, JointsOfTheProblemHaveTheUrdfsNames) {
  WriteFile(folder_ / "arm.urdf", PublishedUrdfs().front().text);
  const std::optional<ProblemSpec> spec = Read(kUrdfProblem);
  ASSERT_TRUE(spec) << diagnostics_.ToString();
  EXPECT_EQ(spec->robot.joints[2].name, "elbow_joint");
  EXPECT_EQ(spec->robot.joints[2].lower, -2.5);
  EXPECT_EQ(spec->robot.links.size(), 6);
  EXPECT_EQ(spec->urdf->tip_link, "tool0");
}

}  // namespace
}  // namespace dhcal
