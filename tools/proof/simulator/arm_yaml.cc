#include "tools/proof/simulator/arm_yaml.h"

#include <fmt/format.h>

#include "core/base/units.h"

namespace dhcal::concealed {

std::string YamlList(const Eigen::Vector3d& v) {
  return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x(), v.y(), v.z());
}

std::string JointsYaml(const Arm& arm) {
  std::string text = "  joints:\n";
  for (const DrawnLink& link : arm.links) {
    text +=
        fmt::format("    - {{theta_deg: {:.9g}, d_m: {:.9g}, a_m: {:.9g}, alpha_deg: {:.9g}{}}}\n",
                    link.theta / kDegree,
                    link.d,
                    link.a,
                    link.alpha / kDegree,
                    link.slides ? ", type: prismatic" : "");
  }
  return text;
}

std::string MassesYaml(const Arm& arm) {
  std::string text = "  links:\n";
  for (const DrawnLink& link : arm.links) {
    text += fmt::format("    - {{mass_kg: {:.4g}, com_m: {}}}\n", link.mass, YamlList(link.com));
  }
  return text + fmt::format("  payload: {{mass_kg: {:.4g}, com_m: {}}}\n",
                            arm.payload,
                            YamlList(arm.payload_com));
}

}  // namespace dhcal::concealed
