#include "tests/support/robots.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "core/base/units.h"

namespace dhcal {
namespace {

JointRow Revolute(double d, double a, double alpha_deg, double theta_deg = 0) {
  JointRow row;
  row.theta = theta_deg * kDegree;
  row.d = d;
  row.a = a;
  row.alpha = alpha_deg * kDegree;
  return row;
}

RobotModel Assemble(const std::string& name,
                    DhConvention convention,
                    std::vector<JointRow> joints) {
  RobotModel robot;
  robot.name = name;
  robot.convention = convention;
  robot.joints = std::move(joints);
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    robot.joints[i].name = "A" + std::to_string(i + 1);
  }
  robot.X_WB = MakeFrame({1.2, -0.4, 0.3}, {0.3, -0.5, 1.1});
  robot.X_TQ = MakeFrame({0.05, -0.08, 0.21}, {-0.7, 0.4, 0.2});
  return robot;
}

Eigen::VectorXd Degrees(std::initializer_list<double> degrees) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(degrees.size()));
  std::copy(degrees.begin(), degrees.end(), q.data());
  return q * kDegree;
}

std::vector<NamedPose> Kr15Poses() {
  // Elbow: the wrist's centre, (0.155, 0.6) from joint 3, on the line through joints 2 and 3.
  const double stretched = std::atan2(0.600, 0.155) / kDegree;
  return {{"zero", Degrees({0, 0, 0, 0, 0, 0}), true},
          {"home", Degrees({0, 90, 0, 0, 0, 0}), true},
          {"elbow", Degrees({20, 40, stretched, 30, 50, -70}), true},
          {"wrist", Degrees({-30, 70, -20, 40, 0, 15}), true}};
}

}  // namespace

Eigen::Isometry3d MakeFrame(const Eigen::Vector3d& p, const Eigen::Vector3d& turn) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0) X.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  X.pretranslate(p);
  return X;
}

RobotModel Kr15() {
  return Assemble("kr15",
                  DhConvention::kStandard,
                  {Revolute(0.675, 0.300, 90),
                   Revolute(0, 0.650, 0),
                   Revolute(0, 0.155, 90),
                   Revolute(0.600, 0, -90),
                   Revolute(0, 0, 90),
                   Revolute(0.140, 0, 0)});
}

RobotModel Kr15Modified() {
  // a and alpha move one row on; the last row's, both zero, would belong to the tool.
  return Assemble("kr15_modified",
                  DhConvention::kModified,
                  {Revolute(0.675, 0, 0),
                   Revolute(0, 0.300, 90),
                   Revolute(0, 0.650, 0),
                   Revolute(0.600, 0.155, 90),
                   Revolute(0, 0, -90),
                   Revolute(0.140, 0, 90)});
}

RobotModel Ur10() {
  return Assemble("ur10",
                  DhConvention::kStandard,
                  {Revolute(0.1273, 0, 90),
                   Revolute(0, -0.612, 0),
                   Revolute(0, -0.5723, 0),
                   Revolute(0.163941, 0, 90),
                   Revolute(0.1157, 0, -90),
                   Revolute(0.0922, 0, 0)});
}

RobotModel Panda() {
  RobotModel robot = Assemble("panda",
                              DhConvention::kModified,
                              {Revolute(0.333, 0, 0),
                               Revolute(0, 0, -90),
                               Revolute(0.316, 0, 90),
                               Revolute(0, 0.0825, 90),
                               Revolute(0.384, -0.0825, -90),
                               Revolute(0, 0, 90),
                               Revolute(0, 0.088, 90)});
  robot.X_TQ = MakeFrame({0, 0, 0.107}, {0, 0, 0}) * robot.X_TQ;  // the flange, row F of the sheet
  return robot;
}

RobotModel Scara() {
  RobotModel robot = Assemble("scara",
                              DhConvention::kStandard,
                              {Revolute(0.387, 0.325, 0),
                               Revolute(0, 0.275, 180),
                               Revolute(0.05, 0, 0, 25),
                               Revolute(0.08, 0, 0)});
  robot.joints[1].sign = -1;
  robot.joints[1].beta = 0.01;
  robot.joints[2].type = JointType::kPrismatic;
  robot.joints[2].sign = -1;
  return robot;
}

RobotModel ScaraModified() {
  RobotModel robot = Scara();
  robot.name = "scara_modified";
  robot.convention = DhConvention::kModified;
  return robot;
}

std::vector<JointRow> JointsOf(const std::string& letters) {
  std::vector<JointRow> joints(letters.size());
  for (std::size_t i = 0; i < letters.size(); ++i) {
    joints[i].type = letters[i] == 'R' ? JointType::kRevolute : JointType::kPrismatic;
  }
  return joints;
}

RobotModel WithPlainEnds(RobotModel robot) {
  robot.X_WB.setIdentity();
  robot.X_TQ.setIdentity();
  return robot;
}

std::vector<TestRobot> TestRobots() {
  const std::vector<NamedPose> ur10 = {{"zero", Degrees({0, 0, 0, 0, 0, 0}), true},
                                       {"home", Degrees({0, -90, 90, -90, -90, 0})},
                                       {"elbow", Degrees({30, -60, 0, -40, 80, 10}), true},
                                       {"wrist", Degrees({30, -60, 70, -40, 0, 10}), true}};
  const std::vector<NamedPose> panda = {{"zero", Degrees({0, 0, 0, 0, 0, 0, 0}), true},
                                        {"home", Degrees({0, -45, 0, -135, 0, 90, 45})},
                                        {"elbow", Degrees({20, 35, -50, 0, 0, 60, 45})},
                                        {"wrist", Degrees({20, 35, -50, -70, 25, 0, 45})}};
  const Eigen::Vector4d scara_home(0.4, 0.9, 0.1, -0.3), scara_stretched(0.4, 0, -0.1, 0.2);
  const std::vector<NamedPose> scara = {
      {"zero", Eigen::Vector4d::Zero()}, {"home", scara_home}, {"elbow", scara_stretched}};
  // Modified rows put axes 2 and 4 on one line, whatever the pose.
  std::vector<NamedPose> scara_modified = scara;
  for (NamedPose& pose : scara_modified) pose.singular = true;
  return {{Kr15(), Kr15Poses()},
          {Kr15Modified(), Kr15Poses()},
          {Ur10(), ur10},
          {Panda(), panda},
          {Scara(), scara},
          {ScaraModified(), scara_modified}};
}

std::ostream& operator<<(std::ostream& os, const TestRobot& robot) {
  return os << robot.model.name;
}

Eigen::VectorXd RandomJoints(const RobotModel& robot, Rng* rng) {
  Eigen::VectorXd q(robot.num_joints());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const bool slides = robot.joints[static_cast<std::size_t>(i)].type == JointType::kPrismatic;
    const double range = slides ? 0.3 : 2.5;
    q[i] = rng->Uniform(-range, range);
  }
  return q;
}

Eigen::VectorXd RandomSlots(const RobotModel& robot, double size, Rng* rng) {
  Eigen::VectorXd delta(5 * robot.num_joints() + 12);
  for (double& value : delta) value = rng->Uniform(-size, size);
  return delta;
}

}  // namespace dhcal
