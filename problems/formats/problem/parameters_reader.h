// Reads the section `parameters` of a problem file.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_PARAMETERS_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_PARAMETERS_READER_H_

#include "core/io/yaml_map.h"
#include "core/io/yaml_value.h"
#include "core/model/problem_spec.h"
#include "core/model/robot.h"

namespace dhcal {

/// Names are checked against `robot`. In `prior_sigma` the groups base and tool become the keys
/// "base:m", "base:rad", "tool:m" and "tool:rad"; all others are the bare name.
void ReadParameters(const YamlValue& value, const RobotModel& robot, ParameterSpec* parameters);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_PARAMETERS_READER_H_
