// Reads the section `simulate` of a problem file.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_SIMULATION_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_SIMULATION_READER_H_

#include "core/io/yaml_value.h"
#include "core/model/problem_spec.h"
#include "problems/formats/problem/path_resolver.h"

namespace dhcal {

/// `robot` gives the number and types of the joints, `kind` what the noise may hold.
void ReadSimulation(const YamlValue& value,
                    const RobotModel& robot,
                    const MeasurementKind& kind,
                    const PathResolver& resolve_path,
                    SimulationSpec* simulation);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_SIMULATION_READER_H_
