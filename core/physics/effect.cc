#include "core/physics/effect.h"

#include <algorithm>

#include <fmt/format.h>

namespace dhcal {

EffectRequest Effect::Request(int joint) const {
  EffectRequest request;
  request.effect = name();
  request.joint = joint;
  return request;
}

const EffectSetting* Effect::FindSetting(const std::string& setting) const {
  const auto& all = description_.settings;
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const EffectSetting& s) { return s.name == setting; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<EffectRequest> Effect::Candidates(const PhysicsContext& /*context*/) const {
  return {Request()};
}

EffectRequest WithSetting(EffectRequest request, const std::string& setting, double value) {
  request.settings[setting] = value;
  return request;
}

EffectRequest WithValue(EffectRequest request, const std::string& parameter, double value) {
  request.values[parameter] = value;
  return request;
}

std::string ParameterName(const EffectRequest& request, const std::string& parameter) {
  if (request.joint == 0) return request.effect + "." + parameter;
  return fmt::format("{}.{}.{}", request.effect, request.joint, parameter);
}

std::string InstanceName(const EffectRequest& request) {
  std::string name = request.effect;
  if (request.joint > 0) name += fmt::format(" at joint {}", request.joint);
  std::string settings;
  for (const auto& [key, value] : request.settings) {
    settings += fmt::format("{}{} {:.6g}", settings.empty() ? "" : ", ", key, value);
  }
  return settings.empty() ? name : name + " (" + settings + ")";
}

}  // namespace dhcal
