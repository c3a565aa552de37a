// The effects of a problem with the values that its fit found.
#include <algorithm>
#include <string>
#include <vector>

#include "core/physics/registry.h"
#include "problems/formats/result/result_writer.h"

namespace dhcal {

namespace {

/// True if the fit estimated geometry, too: a file with nothing left to estimate would be refused.
bool EstimatesGeometry(const std::vector<ParameterResult>& parameters) {
  return std::any_of(parameters.begin(), parameters.end(), [](const ParameterResult& p) {
    return p.unit != Unit::kOther && p.verdict != Verdict::kFixed;
  });
}

}  // namespace

std::vector<EffectRequest> EffectsAsFound(const ProblemSpec& spec,
                                          const Recording& recording,
                                          const std::vector<ParameterResult>& parameters) {
  std::vector<EffectRequest> effects = spec.parameters.effects;
  if (effects.empty() || !EstimatesGeometry(parameters)) return effects;
  const PhysicsContext context(spec.robot, recording, {spec.robot.X_WB});
  // One name may come twice (a joint that two others drive); then the order tells them apart, which
  // is that of the effects.
  auto next = parameters.begin();
  for (EffectRequest& effect : effects) {
    if (effect.held) continue;
    for (const EffectColumn& column : EffectColumns(context, effect)) {
      const std::string name = ParameterName(effect, column.parameter);
      const auto found = std::find_if(
          next, parameters.end(), [&](const ParameterResult& p) { return p.name == name; });
      if (found == parameters.end()) return spec.parameters.effects;  // not of this fit
      effect.values[column.parameter] = found->value;
      next = found + 1;
    }
    effect.held = true;
  }
  return effects;
}

}  // namespace dhcal
