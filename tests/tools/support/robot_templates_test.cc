// The templates of robots, judged by link models of other people (shifts and axes, no DH), by
// reaches of data sheets and poses of textbooks, and by finding errors put into each.

#include "tools/support/robot_templates.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kinematics/dh_chain.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/identify.h"
#include "problems/simulate.h"
#include "residuals/registry.h"
#include "tests/support/files.h"
#include "tests/support/link_model.h"
#include "tests/support/recorder.h"

namespace dhcal {
namespace {

using Eigen::Vector3d;
using ::testing::Contains;
using ::testing::SizeIs;

const Vector3d kX = Vector3d::UnitX(), kY = Vector3d::UnitY(), kZ = Vector3d::UnitZ();
constexpr double kQuarter = M_PI / 2;

std::string Templates() { return SourcePath("problems/robots"); }

ProblemSpec Template(const std::string& name) {
  Diagnostics diagnostics;
  const std::optional<ProblemSpec> spec =
      ReadProblemFile(RobotTemplateFile(Templates(), name), "", &diagnostics);
  EXPECT_TRUE(spec.has_value()) << diagnostics.ToString();
  return spec.value_or(ProblemSpec());
}

/// An upright arm with a wrist of three axes that meet; axes as the descriptions turn them.
LinkModel Upright(
    double height, double out, double arm, double up, double forearm, double hand, double sense) {
  return {{{{0, 0, height}, kZ},
           {{out, 0, 0}, kY},
           {{0, 0, arm}, sense * kY},
           {{0, 0, up}, sense * kX},
           {{forearm, 0, 0}, sense * kY},
           {{0, 0, 0}, sense * kX}},
          {hand, 0, 0}};
}

/// Stretched out forward, as KUKA counts.
LinkModel Kuka(double height, double out, double arm, double up, double forearm, double hand) {
  return {{{{0, 0, height}, -kZ},
           {{out, 0, 0}, kY},
           {{arm, 0, 0}, kY},
           {{0, 0, up}, -kX},
           {{forearm, 0, 0}, kY},
           {{0, 0, 0}, -kX}},
          {hand, 0, 0}};
}

/// config/ur30/default_kinematics.yaml of Universal_Robots_ROS2_Description, with any lengths.
LinkModel Ur(double d1, double a2, double a3, double d4, double d5, double d6) {
  return {{{{0, 0, d1}, kZ},
           {{0, 0, 0}, kZ, {kQuarter, 0, 0}},
           {{a2, 0, 0}, kZ},
           {{a3, 0, d4}, kZ},
           {{0, -d5, 0}, kZ, {kQuarter, 0, 0}},
           {{0, d6, 0}, kZ, {kQuarter, M_PI, M_PI}}}};
}

struct Described {
  const char* name;
  LinkModel model;
  Vector3d tool = {0, 0, 0.1};  // [m] that the template comes with, in the axes of its last row
};

std::vector<Described> DescribedRobots() {
  return {
      {"ur3e", Ur(0.15185, -0.24355, -0.2132, 0.13105, 0.08535, 0.0921)},
      {"ur5e", Ur(0.1625, -0.425, -0.3922, 0.1333, 0.0997, 0.0996)},
      {"ur10e", Ur(0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655)},
      {"ur20", Ur(0.2363, -0.862, -0.7287, 0.201, 0.1593, 0.1543)},
      {"ur30", Ur(0.2363, -0.637, -0.5037, 0.201, 0.1593, 0.1543)},
      {"ur3", Ur(0.1519, -0.24365, -0.21325, 0.11235, 0.08535, 0.0819)},
      {"ur5", Ur(0.089159, -0.425, -0.39225, 0.10915, 0.09465, 0.0823)},
      {"ur10", Ur(0.1273, -0.612, -0.5723, 0.163941, 0.1157, 0.0922)},
      {"kuka_kr6_r900", Kuka(0.4, 0.025, 0.455, 0.035, 0.42, 0.08)},
      {"kuka_kr15_2", Kuka(0.675, 0.3, 0.65, 0.155, 0.6, 0.14)},
      {"abb_irb120", Upright(0.29, 0, 0.27, 0.07, 0.302, 0.072, 1)},
      {"abb_irb1600", Upright(0.4865, 0.15, 0.475, 0, 0.6, 0.065, 1)},
      {"abb_irb140", Upright(0.352, 0.07, 0.36, 0, 0.38, 0.065, 1)},
      {"fanuc_lrmate200id", Upright(0.33, 0.05, 0.33, 0.035, 0.335, 0.08, -1)},
      {"motoman_gp7", Upright(0.33, 0.04, 0.445, 0.04, 0.44, 0.08, -1)},
      {"staubli_tx2_60",
       {{{{0, 0, 0.375}, kZ},
         {{0, 0, 0}, kY},
         {{0, 0.02, 0.29}, kY},
         {{0, 0, 0}, kZ},
         {{0, 0, 0.31}, kY},
         {{0, 0, 0.07}, kZ}}}},
      {"franka_panda",
       {{{{0, 0, 0.333}, kZ},
         {{0, 0, 0}, kZ, {-kQuarter, 0, 0}},
         {{0, -0.316, 0}, kZ, {kQuarter, 0, 0}},
         {{0.0825, 0, 0}, kZ, {kQuarter, 0, 0}},
         {{-0.0825, 0.384, 0}, kZ, {-kQuarter, 0, 0}},
         {{0, 0, 0}, kZ, {kQuarter, 0, 0}},
         {{0.088, 0, 0}, kZ, {kQuarter, 0, 0}}},
        {0, 0, 0.107}}},
      {"kuka_iiwa14",
       {{{{0, 0, 0.1525}, kZ},
         {{0, 0, 0.2075}, kY},
         {{0, 0, 0.2325}, kZ},
         {{0, 0, 0.1875}, -kY},
         {{0, 0, 0.2125}, kZ},
         {{0, 0, 0.1875}, kY},
         {{0, 0, 0.126}, kZ}}}},
      {"scara_cobra600",
       {{{{0, 0, 0.387}, kZ},
         {{0.325, 0, 0}, kZ},
         {{0.275, 0, 0}, -kZ, Vector3d::Zero(), true},
         {{0, 0, 0}, -kZ}}},
       {0.04, 0, 0}},
      {"gantry",
       {{{{0, 0, 0}, kX, Vector3d::Zero(), true},
         {{0, 0, 0}, kY, Vector3d::Zero(), true},
         {{0, 0, 0}, kZ, Vector3d::Zero(), true},
         {{0, 0, 0}, kZ}}},
       {0.04, 0, 0}},
  };
}

/// Poses of the tool of a template's robot at random joint coordinates, by its whole way through
/// the program: file, effects of the file, recording.
Recording ToolPoses(ProblemSpec spec) {
  const int n = spec.robot.num_joints();
  spec.measurement.kind = KindNamed("pose");
  spec.recording.clear();
  spec.simulate.emplace();
  spec.simulate->motion.num_poses = 40;
  spec.simulate->motion.lower = Eigen::VectorXd::Constant(n, -2.5);
  spec.simulate->motion.upper = Eigen::VectorXd::Constant(n, 2.5);
  spec.simulate->effects = spec.parameters.effects;
  spec.parameters.effects.clear();
  spec.simulate->seed = 7;
  Diagnostics diagnostics;
  const std::optional<Recording> recording = SimulateRecording(spec, &diagnostics);
  EXPECT_TRUE(recording.has_value()) << diagnostics.ToString();
  return recording.value_or(Recording());
}

/// The joint coordinates of a description where the controller counts joint 3 against the horizon.
Eigen::VectorXd AgainstTheUpperArm(const std::string& name, Eigen::VectorXd q) {
  if (name == "fanuc_lrmate200id") q[2] += q[1];  // J3_out = J3_in + J23_factor * J2_in
  return q;
}

TEST(RobotTemplates, StandAsTheLinksOfOtherPeoplesDescriptionsDo) {
  for (const Described& described : DescribedRobots()) {
    SCOPED_TRACE(described.name);
    const Recording recording = ToolPoses(Template(described.name));
    ASSERT_EQ(recording.num_rows(), 40);
    // Between the axes of two ways to draw the flange: the same in all poses.
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    for (int row = 0; row < recording.num_rows(); ++row) {
      const Eigen::VectorXd q = AgainstTheUpperArm(described.name, recording.q.row(row));
      const Eigen::Isometry3d X = FlangeOf(described.model, q);
      const Eigen::RowVector4d w_x_y_z = recording.quaternion.row(row);
      const Eigen::Quaterniond R(w_x_y_z[0], w_x_y_z[1], w_x_y_z[2], w_x_y_z[3]);
      if (row == 0) turn = X.linear().transpose() * R.matrix();
      EXPECT_LT((X.linear() * turn - R.matrix()).norm(), 1e-9);
      const Vector3d p = X.translation() + R * described.tool;
      EXPECT_LT((recording.p_WQ.row(row).transpose() - p).norm(), 1e-9);
    }
  }
}

TEST(RobotTemplates, AllAreHeldAgainstADescriptionOrATextbook) {
  std::vector<std::string> held = {"puma560"};
  for (const Described& described : DescribedRobots()) held.push_back(described.name);
  std::sort(held.begin(), held.end());
  EXPECT_EQ(RobotTemplateNames(Templates()), held);
  EXPECT_GE(held.size(), 15u);
}

/// Farthest from the first axis that the centre of the wrist comes in the plane of the arm [m].
double Reach(const RobotModel& robot) {
  const DhChain chain(robot);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(robot.num_joints());
  constexpr int kSteps = 360;
  double reach = 0;
  for (int i = 0; i < kSteps; ++i) {
    q[1] = 2 * M_PI * i / kSteps;
    for (int j = 0; j < kSteps; ++j) {
      q[2] = 2 * M_PI * j / kSteps;
      reach = std::max(reach, chain.LinkFrames(q)[4].translation().head<2>().norm());
    }
  }
  return reach;
}

TEST(RobotTemplates, ReachAsFarAsTheirDataSheetsSay) {
  const std::vector<std::pair<const char*, double>> sheets = {{"abb_irb120", 0.580},
                                                              {"abb_irb140", 0.810},
                                                              {"fanuc_lrmate200id", 0.717},
                                                              {"kuka_kr15_2", 1.570},
                                                              {"kuka_kr6_r900", 0.9015},
                                                              {"motoman_gp7", 0.927},
                                                              {"staubli_tx2_60", 0.600}};
  for (const auto& [name, reach] : sheets) {
    EXPECT_NEAR(Reach(Template(name).robot), reach, 0.6e-3) << name;
  }
}

Vector3d FlangeAt(const std::string& name, const Eigen::VectorXd& q) {
  return DhChain(Template(name).robot).LinkFrames(q).back().translation();
}

TEST(RobotTemplates, StandWhereTextbooksAndMakersSay) {
  // Corke, Robotics, Vision and Control: the Puma's poses qz (all zero) and qr (ready).
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  EXPECT_LT((FlangeAt("puma560", q) - Vector3d(0.4521, -0.1500, 0.4318)).norm(), 1e-4);
  q << 0, kQuarter, -kQuarter, 0, 0, 0;
  EXPECT_LT((FlangeAt("puma560", q) - Vector3d(0.0203, -0.1500, 0.8636)).norm(), 1e-4);
  // Universal Robots' teach pendant at all zero.
  q.setZero();
  EXPECT_LT((FlangeAt("ur5e", q) - Vector3d(-0.8172, -0.2329, 0.0628)).norm(), 1e-9);
  // The iiwa stretched upward is 1306 mm high.
  q = Eigen::VectorXd::Zero(7);
  EXPECT_LT((FlangeAt("kuka_iiwa14", q) - Vector3d(0, 0, 1.306)).norm(), 1e-9);
}

/// The KR 15/2 as the paper's table has it and as KUKA counts is one robot.
TEST(RobotTemplates, TheKr15IsThatOfThePaper) {
  Diagnostics diagnostics;
  const std::optional<ProblemSpec> paper =
      ReadProblemFile(SourcePath("problems/cases/kr15.yaml"), "", &diagnostics);
  ASSERT_TRUE(paper.has_value()) << diagnostics.ToString();
  Eigen::VectorXd q(6), of_paper(6);
  q << 0.3, -1.2, 1.4, 0.7, -0.8, 0.2;
  of_paper << -q[0], -q[1], kQuarter - q[2], -q[3], -q[4], -q[5];
  const Vector3d p = DhChain(paper->robot).LinkFrames(of_paper).back().translation();
  EXPECT_LT((FlangeAt("kuka_kr15_2", q) - p).norm(), 1e-12);
}

TEST(RobotTemplates, ErrorsPutIntoEachAreFound) {
  constexpr double kSigma = 20e-6;  // [m]
  for (const std::string& name : RobotTemplateNames(Templates())) {
    SCOPED_TRACE(name);
    const ProblemSpec spec = Template(name);
    const TrueRobot truth = MakeTrueRobot(spec.robot, 5);
    RecordingPlan plan;
    plan.sigma = kSigma;
    plan.seed = 11;
    Recording recording = Record(truth, spec, plan);
    if (name == "fanuc_lrmate200id") recording.q.col(2) -= recording.q.col(1);
    const Result result = IdentifyGeometry(spec, recording, Progress());
    ASSERT_NE(result.best(), nullptr);
    EXPECT_NEAR(result.noise_sigma / kSigma, 1.0, 0.15);
    EXPECT_LT(PredictionError(truth, spec, result.calibrated, 99), std::sqrt(3.0) * kSigma);
  }
}

TEST(RobotTemplates, AFolderThatIsNotThereHasNone) {
  EXPECT_THAT(RobotTemplateNames(Templates() + "/none"), SizeIs(0));
  EXPECT_THAT(RobotTemplateNames(RobotTemplatesFolder()), Contains("ur5e"));
}

}  // namespace
}  // namespace dhcal
