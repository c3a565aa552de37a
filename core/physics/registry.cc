#include "core/physics/registry.h"

#include <unordered_map>

#include <glog/logging.h>

namespace dhcal {

// One line per effect: DHCAL_EFFECT(X) is the function X() that its file defines.
#define DHCAL_EFFECT_LIST(DHCAL_EFFECT) \
  DHCAL_EFFECT(JointCompliance)         \
  DHCAL_EFFECT(TorsionNonlinearity)     \
  DHCAL_EFFECT(GravityBalancer)         \
  DHCAL_EFFECT(LinkBending)             \
  DHCAL_EFFECT(BaseCompliance)          \
  DHCAL_EFFECT(JointGain)               \
  DHCAL_EFFECT(GearHarmonic)            \
  DHCAL_EFFECT(TransmissionError)       \
  DHCAL_EFFECT(JointCoupling)           \
  DHCAL_EFFECT(Backlash)                \
  DHCAL_EFFECT(AxisWobble)              \
  DHCAL_EFFECT(LinkThermal)             \
  DHCAL_EFFECT(BaseDrift)               \
  DHCAL_EFFECT(JointDrift)              \
  DHCAL_EFFECT(JointStep)               \
  DHCAL_EFFECT(ToolStep)                \
  DHCAL_EFFECT(Latency)                 \
  DHCAL_EFFECT(SensorScale)             \
  DHCAL_EFFECT(AxisTilt)                \
  DHCAL_EFFECT(BaseFrame)               \
  DHCAL_EFFECT(ToolOffset)

#define DHCAL_DECLARE(name) const Effect& name();
DHCAL_EFFECT_LIST(DHCAL_DECLARE)
#undef DHCAL_DECLARE

namespace {

/// The effect of the library that a predicate is true for.
template <typename Predicate>
const Effect& Only(Predicate predicate) {
  for (const Effect* const effect : AllEffects()) {
    if (predicate(*effect)) return *effect;
  }
  LOG(FATAL) << "the library lacks an effect that the diagnosis needs";
}

}  // namespace

const std::vector<const Effect*>& AllEffects() {
#define DHCAL_POINTER(name) &name(),
  static const std::vector<const Effect*> effects = {DHCAL_EFFECT_LIST(DHCAL_POINTER)};
#undef DHCAL_POINTER
  return effects;
}

const Effect* FindEffect(const std::string& name) {
  static const auto* const by_name = [] {
    auto* const map = new std::unordered_map<std::string, const Effect*>();
    for (const Effect* const effect : AllEffects()) map->emplace(effect->name(), effect);
    return map;
  }();
  const auto found = by_name->find(name);
  return found == by_name->end() ? nullptr : found->second;
}

const Effect& CurveEffect() {
  return Only([](const Effect& effect) { return effect.Describe().is_curve; });
}

const Effect& LineEffect() {
  return Only(
      [](const Effect& effect) { return effect.Describe().per_joint == PerJoint::kManyLines; });
}

EffectRequest Line(int joint, double order) {
  for (const EffectSetting& setting : LineEffect().Describe().settings) {
    if (setting.scan != SettingScan::kOrders) continue;
    return WithSetting(LineEffect().Request(joint), setting.name, order);
  }
  LOG(FATAL) << LineEffect().name() << " has no order";
}

const Effect* EffectThatCompletes(ParameterGroup group) {
  for (const Effect* const effect : AllEffects()) {
    if (effect->Describe().completes == group) return effect;
  }
  return nullptr;
}

std::vector<std::string> EffectNames() {
  std::vector<std::string> names;
  for (const Effect* const effect : AllEffects()) names.push_back(effect->name());
  return names;
}

std::vector<EffectColumn> EffectColumns(const PhysicsContext& context,
                                        const EffectRequest& request) {
  const Effect* const effect = FindEffect(request.effect);
  CHECK(effect != nullptr) << request.effect;
  return effect->Columns(context, request);
}

}  // namespace dhcal
