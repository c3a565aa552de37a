// A robot as it was recorded, by an independent forward kinematics, and the files that say so: what
// set-ups are tried on.
#ifndef DHCAL_TESTS_SUPPORT_SET_UP_FILES_H_
#define DHCAL_TESTS_SUPPORT_SET_UP_FILES_H_

#include <string>

#include "core/base/rng.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/robot.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/robots.h"

namespace dhcal {

/// `estimate: complete` of readings of this kind, as a file would say it.
inline ProblemSpec ProblemOf(const RobotModel& robot, const MeasurementKind& kind) {
  ProblemSpec spec;
  spec.name = "set_up";
  spec.robot = robot;
  spec.robot.where = {"problem.yaml", 3, 1};
  for (int j = 0; j < robot.num_joints(); ++j) {
    JointRow& row = spec.robot.joints[static_cast<std::size_t>(j)];
    row.where = {"problem.yaml", 5 + j, 7};
    row.name = "J" + std::to_string(j + 1);
  }
  spec.measurement.kind = kind;
  spec.parameters.estimate = {"complete"};
  return spec;
}

/// Random poses of a robot whose rows are a millimetre and a milliradian off, seen from a base far
/// away; positions and orientations with noise of `noise` [m] and [rad].
inline Recording RecordingOfRobot(
    const RobotModel& robot, int rows, double noise, Rng* rng, double errors = 1) {
  RobotModel real = robot;
  for (JointRow& row : real.joints) {
    row.theta += 1e-3 * errors * rng->Normal();
    row.alpha += 0.5e-3 * errors * rng->Normal();
    row.a += 0.3e-3 * errors * rng->Normal();
    row.d += 0.3e-3 * errors * rng->Normal();
  }
  const Eigen::Isometry3d X_WB = MakeFrame({2.1, -1.3, 0.4}, {0.3, -0.8, 1.1});
  const Eigen::Isometry3d X_TQ = MakeFrame({0.03, -0.05, 0.12}, {0.1, 0.2, -0.3});
  Recording recording;
  recording.file = "recording.csv";
  recording.header_line = 1;
  recording.q.resize(rows, robot.num_joints());
  recording.p_WQ.resize(rows, 3);
  recording.quaternion.resize(rows, 4);
  for (int row = 0; row < rows; ++row) {
    const Eigen::VectorXd q = RandomJoints(robot, rng);
    const independent::Vector<double> zero =
        independent::Vector<double>::Zero(5 * robot.num_joints() + 12);
    const Eigen::Matrix4d X = independent::ForwardKinematics<double>(real, q, zero, X_WB, X_TQ);
    const Eigen::Quaterniond R(Eigen::Matrix3d(X.topLeftCorner<3, 3>()));
    recording.q.row(row) = q.transpose();
    recording.quaternion.row(row) << R.w(), R.x(), R.y(), R.z();
    for (int k = 0; k < 3; ++k) recording.p_WQ(row, k) = X(k, 3) + noise * rng->Normal();
    recording.lines.push_back(row + 2);
  }
  return recording;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_SET_UP_FILES_H_
