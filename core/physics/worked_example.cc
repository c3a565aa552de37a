#include "core/physics/worked_example.h"

#include "core/base/units.h"

namespace dhcal {

RobotModel WorkedExampleRobot() {
  RobotModel robot;
  robot.name = "example arm";
  const double d[] = {0.675, 0, 0, 0.6, 0, 0.14};
  const double a[] = {0.3, 0.65, 0.155, 0, 0, 0};
  const double alpha[] = {90, 0, 90, -90, 90, 0};
  for (int k = 0; k < 6; ++k) {
    JointRow row;
    row.name = "A" + std::to_string(k + 1);
    row.d = d[k];
    row.a = a[k];
    row.alpha = alpha[k] * kDegree;
    robot.joints.push_back(row);
    robot.links.push_back({10.0, Eigen::Vector3d::Zero()});
  }
  robot.X_TQ.translation() = Eigen::Vector3d(0, 0, 0.2);
  robot.anchors = {{"A", Eigen::Vector3d(1.105, 0, -1.265)}};
  HeadSpec head;
  head.camera.p_QS = Eigen::Vector3d(0.02, 0, 0);
  head.lasers[0].p_QS = Eigen::Vector3d(-0.03, 0.05, 0.01);
  head.lasers[1].p_QS = Eigen::Vector3d(-0.03, -0.05, 0.01);
  head.pitch = 1e-3;
  robot.head = head;
  robot.gravity_B = Eigen::Vector3d(0, 0, -10);  // round numbers in the examples
  return robot;
}

Recording WorkedExampleRecording() {
  Recording recording;
  const Eigen::Matrix<double, 1, 6> q =
      (Eigen::Matrix<double, 1, 6>() << 10, 20, 30, 40, 50, 60).finished() * kDegree;
  recording.q.setZero(3, 6);
  recording.q.row(1) = q;
  recording.q.row(2) = -q;
  recording.direction = Eigen::MatrixXd::Ones(3, 6);
  recording.direction.row(2).setConstant(-1);
  recording.time = Eigen::Vector3d(0, 3600, 7200);
  recording.temperature = Eigen::Vector3d(20, 30, 20);
  recording.speed = Eigen::MatrixXd::Zero(3, 6);
  recording.speed.row(1).setConstant(0.5);
  recording.speed.row(2).setConstant(-0.5);
  recording.torque = Eigen::MatrixXd::Zero(3, 6);
  recording.torque.row(1).setConstant(100);
  recording.torque.row(2).setConstant(-100);
  recording.payload = Eigen::Vector3d(0, 5, 0);
  recording.distance = Eigen::Vector3d::Ones();
  recording.anchor_names = {"A"};
  recording.anchor_idx = {0, 0, 0};
  recording.edge_names = {"E", "F"};
  recording.edge_idx = {0, 0, 1};
  recording.extra.push_back({"motor_temp", Eigen::Vector3d(30, 40, 55)});
  recording.run_names = {"1", "2"};
  recording.run_idx = {0, 0, 1};
  return recording;
}

}  // namespace dhcal
