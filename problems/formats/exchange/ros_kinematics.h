// The kinematics_params_file of ROS' UR drivers: where each joint of the arm is on the link before.
#ifndef DHCAL_PROBLEMS_FORMATS_EXCHANGE_ROS_KINEMATICS_H_
#define DHCAL_PROBLEMS_FORMATS_EXCHANGE_ROS_KINEMATICS_H_

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/diagnostics.h"
#include "core/model/robot.h"

namespace dhcal {

/// What stands for the hash of the controller's calibration where none is known: the driver warns
/// that it differs, and uses the file.
constexpr char kUnknownHash[] = "calib_unknown";

struct RosKinematics {
  std::vector<Eigen::Isometry3d> origins;  // six: shoulder, upper_arm ... wrist_3
  std::string hash = kUnknownHash;
};

std::optional<RosKinematics> ReadRosKinematics(const std::string& file, Diagnostics* diagnostics);

/// The file's text. There must be six origins.
std::string RosKinematicsText(const RosKinematics& kinematics);

/// Joints turn about their frames' z axes and have the names of ur_description; B is the frame
/// base_link_inertia there, and T is tool0.
RobotModel RobotOfRosKinematics(const RosKinematics& kinematics);

/// The origins that the rows have by themselves: those of modified rows, which is how the driver's
/// own files are made of the controller's table.
std::vector<Eigen::Isometry3d> OriginsOfRows(const RobotModel& robot);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_EXCHANGE_ROS_KINEMATICS_H_
