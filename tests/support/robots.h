// Robots that the tests calculate with, as published or built to be awkward.
#ifndef DHCAL_TESTS_SUPPORT_ROBOTS_H_
#define DHCAL_TESTS_SUPPORT_ROBOTS_H_

#include <ostream>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/rng.h"
#include "core/model/robot.h"

namespace dhcal {

// All have a base and a tool that are shifted and turned, unless WithPlainEnds takes them away.

RobotModel Kr15();          // KUKA KR 15/2, standard rows: problems/cases/kr15.yaml
RobotModel Kr15Modified();  // the same robot in modified (Craig's) rows
RobotModel Ur10();          // Universal Robots UR10: problems/cases/ur10_ipa_a.yaml
RobotModel Panda();         // Franka Emika Panda, seven joints, modified rows as its maker prints
RobotModel Scara();  // two turning joints, a sliding one, a wrist; signs -1 and a Hayati beta
RobotModel ScaraModified();  // those rows read as modified ones

/// Rows of nothing but their joint's type: 'R' turns, 'P' slides.
std::vector<JointRow> JointsOf(const std::string& letters);

/// Base and tool at the identity.
RobotModel WithPlainEnds(RobotModel robot);

/// A joint vector with a name for messages.
struct NamedPose {
  std::string name;
  Eigen::VectorXd q;      // [rad] or [m]
  bool singular = false;  // the flange cannot move in all directions that it has joints for
};

struct TestRobot {
  RobotModel model;
  std::vector<NamedPose> poses;
};

/// All of them with their poses: all zero, home, stretched elbow, straight wrist.
std::vector<TestRobot> TestRobots();

/// For GoogleTest's messages.
std::ostream& operator<<(std::ostream& os, const TestRobot& robot);

/// Uniform in +-2.5 rad, sliding joints in +-0.3 m.
Eigen::VectorXd RandomJoints(const RobotModel& robot, Rng* rng);

/// Every slot uniform in +-`size` [rad or m].
Eigen::VectorXd RandomSlots(const RobotModel& robot, double size, Rng* rng);

/// A frame from numbers: shift [m] and rotation vector [rad].
Eigen::Isometry3d MakeFrame(const Eigen::Vector3d& p, const Eigen::Vector3d& turn);

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_ROBOTS_H_
