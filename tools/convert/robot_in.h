// A robot from any of the files that hold one.
#ifndef DHCAL_TOOLS_CONVERT_ROBOT_IN_H_
#define DHCAL_TOOLS_CONVERT_ROBOT_IN_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/robot.h"
#include "problems/formats/urdf/urdf_chain.h"
#include "tools/convert/run.h"

namespace dhcal {

/// A URDF with the chain in it that is meant.
struct UrdfWithChain {
  UrdfTree tree;
  UrdfChain chain;
};

struct RobotIn {
  RobotModel robot;
  std::optional<UrdfWithChain> urdf;  // that the rows come from, or that the options name
  std::vector<std::string> effects;   // which the file has beside the robot
  std::string hash;                   // of a kinematics_params_file
};

/// Reads `options.from` as what it is: by its ending (.urdf, .xml, .conf), and a YAML file by its
/// keys. Nothing after an error.
std::optional<RobotIn> ReadAnyRobot(const ConvertOptions& options, Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CONVERT_ROBOT_IN_H_
