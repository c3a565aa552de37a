// The robot of a problem file, whatever else the file holds or lacks.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_FILE_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_FILE_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/robot.h"

namespace dhcal {

struct RobotFile {
  RobotModel robot;
  std::optional<UrdfSource> urdf;
  std::vector<std::string> effects;  // of `parameters.effects`: "joint_compliance of joint 2"
};

/// Reads `robot` strictly, and of the rest only which effects there are; nothing after an error.
std::optional<RobotFile> ReadRobotFile(const std::string& file,
                                       const std::string& data_dir,
                                       Diagnostics* diagnostics);

/// A file with this robot and nothing else; `about` says in a comment where it is from.
std::string RobotFileText(const RobotModel& robot,
                          const std::string& name,
                          const std::vector<std::string>& about);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_FILE_H_
