// Reads the section `robot` of a problem file.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_READER_H_

#include "core/io/yaml_value.h"
#include "core/model/robot.h"

namespace dhcal {

/// Fills `robot`. A robot without joints afterwards means that their list could not be read; its
/// error stands in the diagnostics.
void ReadRobot(const YamlValue& value, RobotModel* robot);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_READER_H_
