// A URDF made from nothing but a robot's rows.
#ifndef DHCAL_PROBLEMS_FORMATS_URDF_URDF_NEW_H_
#define DHCAL_PROBLEMS_FORMATS_URDF_URDF_NEW_H_

#include <string>
#include <vector>

#include "core/model/robot.h"

namespace dhcal {

/// Links `base_link`, `link_1` ... `link_n` with their frames on their joints' axes (the frames of
/// modified rows), and `tool0` or the targets behind the last one; before them `world`, where the
/// base is not in it. Joints have the robot's names, limits and sense, links their masses (inertia
/// tensors zero). What a URDF cannot hold is said in a comment: `remarks`, and several bases or
/// tools.
std::string UrdfOfRobot(const RobotModel& robot, std::vector<std::string> remarks);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_URDF_URDF_NEW_H_
