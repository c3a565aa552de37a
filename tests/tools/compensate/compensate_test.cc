// Commands for a real robot that is calculated elsewhere: an independent arm with errors, compliant
// joints, a gear that errs and backlash stands where the nominal robot was to stand.
#include "tools/compensate/compensate.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/math/rotation.h"
#include "problems/formats/problem/problem_reader.h"
#include "tests/support/files.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/robots.h"
#include "tests/support/temp_folder.h"
#include "tools/compensate/expected_error.h"
#include "tools/compensate/run.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::HasSubstr;

constexpr double kCompliance = 3e-6;  // [rad/(N m)] of joint 2
constexpr double kBacklash = 3e-4;    // [rad] of joint 4, whole width
constexpr double kRipple = 7e-5;      // [rad] of joint 3
constexpr int kOrder = 7;

/// The KR 15 of the cases as calibrated: errors in its rows, and effects with their values.
std::string Model() {
  return R"(schema: 1
name: model
robot:
  joints:
    - {name: A1, theta_deg: 0.05, d_m: 0.6748, a_m: 0.3003, alpha_deg: 90.02, limits_deg: [-185, 185]}
    - {name: A2, theta_deg: -0.06, d_m: 0.0002, a_m: 0.6503, alpha_deg: 0.03}
    - {name: A3, theta_deg: 0.04, d_m: 0, a_m: 0.1548, alpha_deg: 89.97}
    - {name: A4, theta_deg: 0.08, d_m: 0.6004, a_m: 0, alpha_deg: -90.01}
    - {name: A5, theta_deg: -0.1, d_m: 0, a_m: 0.0002, alpha_deg: 90.02, limits_deg: [-130, 130]}
    - {name: A6, theta_deg: 0, d_m: 0.1401, a_m: 0, alpha_deg: 0}
  base: {xyz_mm: [1500, -200, 40], rpy_deg: [0.5, -0.2, 30]}
  tool: {xyz_m: [0.001, 0.002, 0.2], rpy_deg: [0.1, 0, 0.2]}
  links:
    - {mass_kg: 0, com_m: [0, 0, 0]}
    - {mass_kg: 40, com_m: [-0.3, 0, 0.1]}
    - {mass_kg: 0, com_m: [0, 0, 0]}
    - {mass_kg: 25, com_m: [0, 0, -0.2]}
    - {mass_kg: 0, com_m: [0, 0, 0]}
    - {mass_kg: 0, com_m: [0, 0, 0]}
  payload: {mass_kg: 10, com_m: [0, 0, 0.1]}
measurement: {kind: pose}
parameters:
  effects:
    - {effect: joint_compliance, joint: 2, values: {compliance: 3e-6}}
    - {effect: backlash, joint: 4, values: {width: 3e-4}}
    - {effect: gear_harmonic, joint: 3, order: 7, values: {cos_7: 7e-5, sin_7: 0}}
recording: rows.csv
)";
}

RobotModel ModelRobot() {
  const TempFolder folder;
  WriteFile(folder / "model.yaml", Model());
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(folder / "model.yaml", "", &diagnostics);
  EXPECT_TRUE(spec.has_value()) << diagnostics.ToString();
  return spec->robot;
}

/// Frame of row `link` (from 1) in the base, with `delta` of the joints.
Eigen::Matrix4d LinkFrame(const RobotModel& robot,
                          const VectorXd& q,
                          const VectorXd& delta,
                          int link) {
  Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
  for (int k = 0; k < link; ++k) {
    X = (X * independent::Row<double>(robot.convention, robot.joints[k], q[k], delta, 5 * k))
            .eval();
  }
  return X;
}

/// Torque of gravity about axis 2 [N m] on the bent arm, by hand: all masses beyond joint 2.
double TorqueOnJoint2(const RobotModel& robot, const VectorXd& q, const VectorXd& delta) {
  const Eigen::Matrix4d before = LinkFrame(robot, q, delta, 1);
  const Vector3d axis = before.block<3, 1>(0, 2), point = before.block<3, 1>(0, 3);
  double torque = 0;
  const auto add = [&](double mass, const Eigen::Matrix4d& X, const Vector3d& p) {
    const Vector3d at = X.block<3, 3>(0, 0) * p + X.block<3, 1>(0, 3);
    torque += axis.dot((at - point).cross(mass * robot.gravity_B));
  };
  for (int link = 2; link <= 6; ++link) {
    const LinkMass& mass = robot.links[static_cast<std::size_t>(link - 1)];
    add(mass.mass, LinkFrame(robot, q, delta, link), mass.p_LC);
  }
  add(robot.payload.mass, LinkFrame(robot, q, delta, 6), robot.payload.p_LC);
  return torque;
}

/// Where the true arm's tool is, in its base.
Isometry3d TruePose(const RobotModel& robot, const VectorXd& q, double direction4) {
  VectorXd delta = VectorXd::Zero(42);
  delta[5 * 3] = 0.5 * kBacklash * direction4;
  delta[5 * 2] = kRipple * std::cos(kOrder * q[2]);
  // The compliant joint settles where its load is that of the bent arm.
  for (int turn = 0; turn < 20; ++turn) {
    delta[5 * 1] = kCompliance * TorqueOnJoint2(robot, q, delta);
  }
  Isometry3d X;
  X.matrix() =
      independent::ForwardKinematics<double>(robot, q, delta, Isometry3d::Identity(), robot.X_TQ);
  return X;
}

struct Row {
  VectorXd q;
  int direction;
  Isometry3d X_BQ;
};

/// Poses that the true arm can take near random joints.
std::vector<Row> WantedRows(const RobotModel& robot, int count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Row> rows;
  for (int k = 0; k < count; ++k) {
    VectorXd q(6);
    q << rng.Uniform(-2, 2), rng.Uniform(0.3, 1.9), rng.Uniform(-1.2, 0.8), rng.Uniform(-2, 2),
        rng.Uniform(0.4, 1.8), rng.Uniform(-2, 2);
    Isometry3d X = Isometry3d::Identity();
    X.matrix() = independent::ForwardKinematics<double>(
        robot, q, VectorXd::Zero(42), Isometry3d::Identity(), robot.X_TQ);
    rows.push_back({q, k % 2 == 0 ? 1 : -1, X});
  }
  return rows;
}

std::string Table(const std::vector<Row>& rows) {
  std::string text =
      "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,dir1,dir2,dir3,dir4,dir5,dir6,"
      "x_mm,y_mm,z_mm,qw,qx,qy,qz\n";
  for (const Row& row : rows) {
    for (const double q : row.q) text += std::to_string(q / kDegree) + ",";
    text += "0,0,0," + std::to_string(row.direction) + ",0,0";
    char buffer[64];
    const auto add = [&](double value) {
      std::snprintf(buffer, sizeof buffer, ",%.17g", value);
      text += buffer;
    };
    for (const double x : row.X_BQ.translation()) add(x / kMillimetre);
    const Eigen::Quaterniond q(row.X_BQ.linear());
    for (const double part : {q.w(), q.x(), q.y(), q.z()}) add(part);
    text += "\n";
  }
  return text;
}

/// Cells of a table of the program, by rows; the header first.
std::vector<std::vector<std::string>> Cells(const std::string& table) {
  std::vector<std::vector<std::string>> rows;
  std::stringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

VectorXd JointsIn(const std::vector<std::string>& cells) {
  VectorXd q(6);
  for (int k = 0; k < 6; ++k) q[k] = std::stod(cells[static_cast<std::size_t>(k) + 1]) * kDegree;
  return q;
}

class CompensateProgram : public testing::Test {
 protected:
  CompensateProgram() {
    WriteFile(folder_ / "calibrated.yaml", Model());
    options_.model = folder_ / "calibrated.yaml";
    options_.poses = folder_ / "wanted.csv";
  }
  int Run() {
    out_.str("");
    messages_.str("");
    return RunCompensate(options_, out_, messages_);
  }

  TempFolder folder_;
  CompensateOptions options_;
  std::ostringstream out_, messages_;
};

TEST_F(CompensateProgram, BringsTheTrueArmToItsPoses) {
  const RobotModel robot = ModelRobot();
  const std::vector<Row> rows = WantedRows(robot, 40, 3);
  WriteFile(options_.poses, Table(rows));
  ASSERT_EQ(Run(), kCompensateOk) << messages_.str();
  const auto table = Cells(out_.str());
  ASSERT_EQ(table.size(), rows.size() + 1);
  double before = 0, after = 0, turn = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const VectorXd q = JointsIn(table[k + 1]);
    EXPECT_EQ(table[k + 1].back(), "ok");
    EXPECT_LE(std::stod(table[k + 1][7]), 1) << "nm";
    const Isometry3d reached = TruePose(robot, q, rows[k].direction);
    after = std::max(after, (reached.translation() - rows[k].X_BQ.translation()).norm());
    turn = std::max(
        turn, LogSO3(Eigen::Matrix3d(reached.linear() * rows[k].X_BQ.linear().transpose())).norm());
    const Isometry3d plain = TruePose(robot, rows[k].q, rows[k].direction);
    before = std::max(before, (plain.translation() - rows[k].X_BQ.translation()).norm());
  }
  EXPECT_GT(before, 5e-4);
  // The model bends its arm twice, the true one until it settles: a ten-thousandth of the sag.
  EXPECT_LT(after, 1e-7);
  EXPECT_LT(turn, 1e-7);
}

TEST_F(CompensateProgram, PredictsWhereTheTrueArmIs) {
  const RobotModel robot = ModelRobot();
  const std::vector<Row> rows = WantedRows(robot, 20, 4);
  WriteFile(options_.poses, Table(rows));
  options_.predict = true;
  ASSERT_EQ(Run(), kCompensateOk) << messages_.str();
  const auto table = Cells(out_.str());
  ASSERT_EQ(table.size(), rows.size() + 1);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    VectorXd q(6);
    for (int joint = 0; joint < 6; ++joint) {
      q[joint] = std::stod(std::to_string(rows[k].q[joint] / kDegree)) * kDegree;
    }
    const Vector3d p = TruePose(robot, q, rows[k].direction).translation();
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(std::stod(table[k + 1][static_cast<std::size_t>(c) + 1]), 1e3 * p[c], 1e-4);
    }
  }
}

TEST_F(CompensateProgram, NominalJointsAreWantedWhereTheNominalRobotBelievesThem) {
  WriteFile(folder_ / "nominal.yaml",
            "schema: 1\nrobot:\n  joints:\n"
            "    - {d_m: 0.675, a_m: 0.3, alpha_deg: 90}\n    - {a_m: 0.65}\n"
            "    - {a_m: 0.155, alpha_deg: 90}\n    - {d_m: 0.6, alpha_deg: -90}\n"
            "    - {alpha_deg: 90}\n    - {d_m: 0.14}\n  tool: {xyz_m: [0, 0, 0.2]}\n"
            "measurement: {kind: pose}\nrecording: rows.csv\n");
  options_.nominal = folder_ / "nominal.yaml";
  Diagnostics diagnostics;
  const auto nominal = ReadProblemFile(options_.nominal, "", &diagnostics);
  ASSERT_TRUE(nominal.has_value()) << diagnostics.ToString();
  const RobotModel robot = ModelRobot();
  std::string text =
      "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,dir1,dir2,dir3,dir4,dir5,dir6\n"
      "10,70,-20,15,50,30,1,1,1,1,1,1\n-40,60,10,-30,60,80,1,1,1,-1,1,1\n";
  WriteFile(options_.poses, text);
  ASSERT_EQ(Run(), kCompensateOk) << messages_.str();
  const auto table = Cells(out_.str());
  const double commanded[2][6] = {{10, 70, -20, 15, 50, 30}, {-40, 60, 10, -30, 60, 80}};
  for (std::size_t row = 0; row < 2; ++row) {
    VectorXd q(6);
    for (int k = 0; k < 6; ++k) q[k] = commanded[row][k] * kDegree;
    const Eigen::Matrix4d wanted = independent::ForwardKinematics<double>(
        nominal->robot, q, VectorXd::Zero(42), Isometry3d::Identity(), nominal->robot.X_TQ);
    const Isometry3d reached = TruePose(robot, JointsIn(table[row + 1]), row == 0 ? 1 : -1);
    EXPECT_LT((reached.translation() - wanted.block<3, 1>(0, 3)).norm(), 1e-7);
  }
}

TEST_F(CompensateProgram, RefusesRowsOneByOne) {
  const RobotModel robot = ModelRobot();
  std::vector<Row> rows = WantedRows(robot, 3, 5);
  rows[0].X_BQ.translation() += Vector3d(0, 0, 5);
  // The wrist stretched: A4 and A6 turn about one line.
  rows[1].q[4] = 0.01 * kDegree;
  rows[1].X_BQ.matrix() = independent::ForwardKinematics<double>(
      robot, rows[1].q, VectorXd::Zero(42), Isometry3d::Identity(), robot.X_TQ);
  WriteFile(options_.poses, Table(rows));
  EXPECT_EQ(Run(), kCompensateRefused);
  EXPECT_THAT(messages_.str(), HasSubstr("row 1: out of reach"));
  const auto table = Cells(out_.str());
  ASSERT_EQ(table.size(), 4u);
  EXPECT_EQ(table[1][1], "");
  EXPECT_NE(table[2].back(), "ok");
  EXPECT_EQ(table[3].back(), "ok");
}

TEST_F(CompensateProgram, FollowsAPathFromOneSeed) {
  const RobotModel robot = ModelRobot();
  VectorXd q(6);
  q << 0.1, 1.2, -0.4, 0.2, 0.9, 0.1;
  std::string text = "x_mm,y_mm,z_mm,qw,qx,qy,qz\n";
  std::vector<Isometry3d> wanted;
  // So long a way that from the seed alone the last poses would be found elsewhere, or not at all.
  for (int k = 0; k < 30; ++k) {
    q[0] += 0.04;
    q[3] += 0.06;
    q[5] -= 0.08;
    Isometry3d X = Isometry3d::Identity();
    X.matrix() = independent::ForwardKinematics<double>(
        robot, q, VectorXd::Zero(42), Isometry3d::Identity(), robot.X_TQ);
    wanted.push_back(X);
    char line[300];
    const Eigen::Quaterniond turn(X.linear());
    std::snprintf(line,
                  sizeof line,
                  "%.12f,%.12f,%.12f,%.15f,%.15f,%.15f,%.15f\n",
                  1e3 * X.translation().x(),
                  1e3 * X.translation().y(),
                  1e3 * X.translation().z(),
                  turn.w(),
                  turn.x(),
                  turn.y(),
                  turn.z());
    text += line;
  }
  WriteFile(options_.poses, text);
  options_.seed = "6,69,-23,11,52,6";
  ASSERT_EQ(Run(), kCompensateOk) << messages_.str();
  const auto table = Cells(out_.str());
  VectorXd before;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const VectorXd command = JointsIn(table[k + 1]);
    if (k > 0) {
      EXPECT_LT((command - before).lpNorm<Eigen::Infinity>(), 0.1) << k;
    }
    before = command;
    // The true arm has half its backlash the one or the other way; the table does not say which.
    const Isometry3d reached = TruePose(robot, command, 0);
    EXPECT_LT((reached.translation() - wanted[k].translation()).norm(), 2e-4);
  }
}

TEST_F(CompensateProgram, SaysWhatIsWrongWithItsInput) {
  options_.model.clear();
  options_.frame = "tool";
  EXPECT_EQ(Run(), kCompensateBadInput);
  EXPECT_THAT(messages_.str(), HasSubstr("--model is missing"));
  EXPECT_THAT(messages_.str(), HasSubstr("--frame is 'tool', but 'base' or 'world' is expected"));

  options_.model = folder_ / "calibrated.yaml";
  options_.frame = "base";
  WriteFile(options_.poses, "x_mm,y_mm,z_mm,qw,qx,qy,qz\n900,0,900,1,0,0,0\n");
  EXPECT_EQ(Run(), kCompensateBadInput);
  EXPECT_THAT(messages_.str(), HasSubstr("nothing says on which branch the arm is"));

  options_.seed = "0,70,-20,x";
  EXPECT_EQ(Run(), kCompensateBadInput);
  EXPECT_THAT(messages_.str(), HasSubstr("--seed_deg is '0,70,-20,x'"));

  options_.seed.clear();
  WriteFile(options_.poses, "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n0,70,-20,0,50,0\n");
  EXPECT_EQ(Run(), kCompensateBadInput);
  EXPECT_THAT(messages_.str(), HasSubstr("a wanted pose needs x_mm, y_mm, z_mm"));
}

TEST_F(CompensateProgram, LeavesOutWhatDependsOnMoreThanThePose) {
  std::string model = Model();
  const std::string backlash = "    - {effect: backlash";
  model.insert(model.find(backlash),
               "    - {effect: base_drift, time_constant_s: 3600, values: {x: 1e-4}}\n");
  WriteFile(options_.model, model);
  WriteFile(options_.poses, Table(WantedRows(ModelRobot(), 2, 6)));
  EXPECT_EQ(Run(), kCompensateOk) << messages_.str();
  EXPECT_THAT(messages_.str(), HasSubstr("the effect base_drift"));
  EXPECT_THAT(messages_.str(), HasSubstr("it is not compensated"));
}

TEST_F(CompensateProgram, ExpectsTheErrorThatTheCovarianceAllows) {
  // One parameter, d1, known to 0.1 mm: every point is as uncertain.
  WriteFile(folder_ / "result.json",
            R"({"best_fit": 0, "fits": [{"parameters": [{"name": "d1", "verdict": "identified"},
                {"name": "a1", "verdict": "fixed"}], "covariance": [[1e-8]]}]})");
  WriteFile(options_.poses, Table(WantedRows(ModelRobot(), 3, 7)));
  ASSERT_EQ(Run(), kCompensateOk) << messages_.str();
  const auto table = Cells(out_.str());
  EXPECT_EQ(table[0][9], "expected_error_mm");
  for (int row = 1; row <= 3; ++row) EXPECT_NEAR(std::stod(table[row][9]), 0.1, 1e-9);
}

}  // namespace
}  // namespace dhcal
