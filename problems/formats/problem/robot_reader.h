// Reads the section `robot` of a problem file.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_READER_H_

#include <optional>

#include "core/io/yaml_value.h"
#include "core/model/problem_spec.h"
#include "core/model/robot.h"
#include "problems/formats/problem/path_resolver.h"

namespace dhcal {

/// Fills `robot`. A robot without joints afterwards means that their list could not be read; its
/// error stands in the diagnostics. `urdf` is set where the rows come from a URDF.
void ReadRobot(const YamlValue& value,
               const PathResolver& resolve_path,
               RobotModel* robot,
               std::optional<UrdfSource>* urdf);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_READER_H_
