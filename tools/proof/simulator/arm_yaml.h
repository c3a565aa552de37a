// What a problem file says of an arm, as YAML below `robot`.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_ARM_YAML_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_ARM_YAML_H_

#include <string>

#include <Eigen/Core>

#include "tools/proof/simulator/arm.h"

namespace dhcal::concealed {

std::string YamlList(const Eigen::Vector3d& v);

/// The rows of its drawing.
std::string JointsYaml(const Arm& arm);

/// Masses of links and payload.
std::string MassesYaml(const Arm& arm);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_ARM_YAML_H_
