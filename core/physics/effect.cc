#include "core/physics/effect.h"

#include <fmt/format.h>

namespace dhcal {

std::vector<EffectRequest> Effect::Candidates(const PhysicsContext& /*context*/) const {
  EffectRequest request;
  request.effect = Describe().name;
  return {request};
}

std::string ParameterName(const EffectRequest& request, const std::string& parameter) {
  if (request.joint == 0) return request.effect + "." + parameter;
  return fmt::format("{}.{}.{}", request.effect, request.joint, parameter);
}

std::string InstanceName(const EffectRequest& request) {
  std::string name = request.effect;
  if (request.joint > 0) name += fmt::format(" at joint {}", request.joint);
  std::string settings;
  for (const auto& [key, word] : request.words) {
    settings += fmt::format("{}{} {}", settings.empty() ? "" : ", ", key, word);
  }
  for (const auto& [key, value] : request.settings) {
    settings += fmt::format("{}{} {:.6g}", settings.empty() ? "" : ", ", key, value);
  }
  return settings.empty() ? name : name + " (" + settings + ")";
}

}  // namespace dhcal
