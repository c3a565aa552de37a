#include "core/physics/registry.h"

#include <algorithm>

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
  DHCAL_EFFECT(BaseStep)                \
  DHCAL_EFFECT(Settling)                \
  DHCAL_EFFECT(Latency)                 \
  DHCAL_EFFECT(SensorScale)             \
  DHCAL_EFFECT(LengthOffset)            \
  DHCAL_EFFECT(InstrumentDrift)         \
  DHCAL_EFFECT(EdgeBow)                 \
  DHCAL_EFFECT(EdgeMisalignment)        \
  DHCAL_EFFECT(LaserLinearity)          \
  DHCAL_EFFECT(LaserTilt)               \
  DHCAL_EFFECT(CameraScale)             \
  DHCAL_EFFECT(CameraAbbe)              \
  DHCAL_EFFECT(ColumnDriver)            \
  DHCAL_EFFECT(AxisTilt)                \
  DHCAL_EFFECT(BaseFrame)               \
  DHCAL_EFFECT(ToolOffset)              \
  DHCAL_EFFECT(BasePerRun)              \
  DHCAL_EFFECT(ToolPerRun)

#define DHCAL_DECLARE(name) const Effect& name();
DHCAL_EFFECT_LIST(DHCAL_DECLARE)
#undef DHCAL_DECLARE

const std::vector<const Effect*>& AllEffects() {
#define DHCAL_POINTER(name) &name(),
  static const std::vector<const Effect*> effects = {DHCAL_EFFECT_LIST(DHCAL_POINTER)};
#undef DHCAL_POINTER
  return effects;
}

const Effect* FindEffect(const std::string& name) {
  for (const Effect* const effect : AllEffects()) {
    if (effect->Describe().name == name) return effect;
  }
  return nullptr;
}

const Effect& CurveEffect() {
  for (const Effect* const effect : AllEffects()) {
    if (effect->Describe().is_curve) return *effect;
  }
  LOG(FATAL) << "the library has no free curve";
}

std::vector<std::string> EffectNames() {
  std::vector<std::string> names;
  for (const Effect* const effect : AllEffects()) names.push_back(effect->Describe().name);
  return names;
}

std::optional<WholeRange> WholeSetting(const std::string& setting, int num_joints) {
  constexpr int kMostRows = 10'000'000;
  if (setting == "driver_joint") return WholeRange{1, std::max(num_joints, 1)};
  if (setting == "laser") return WholeRange{1, 2};
  if (setting == "at_row") return WholeRange{1, kMostRows};
  for (const char* const flag : {"flank", "measured_torque", "free_masses"}) {
    if (setting == flag) return WholeRange{0, 1};
  }
  return std::nullopt;
}

bool IsWord(const std::string& setting) { return setting == "column" || setting == "slot"; }

std::vector<EffectColumn> EffectColumns(const PhysicsContext& context,
                                        const EffectRequest& request) {
  const Effect* const effect = FindEffect(request.effect);
  CHECK(effect != nullptr) << request.effect;
  return effect->Columns(context, request);
}

}  // namespace dhcal
