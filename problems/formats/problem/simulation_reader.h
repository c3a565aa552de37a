// Reads the section `simulate` of a problem file.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_SIMULATION_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_SIMULATION_READER_H_

#include <functional>
#include <string>

#include "core/io/yaml_value.h"
#include "core/model/problem_spec.h"

namespace dhcal {

/// Turns a path as the file writes it into one that can be opened.
using PathResolver = std::function<std::string(const YamlValue&)>;

/// `robot` gives the number and types of the joints, `kind` what the noise may hold.
void ReadSimulation(const YamlValue& value,
                    const RobotModel& robot,
                    const MeasurementKind& kind,
                    const PathResolver& resolve_path,
                    SimulationSpec* simulation);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_SIMULATION_READER_H_
