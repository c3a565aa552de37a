#include "core/physics/effect_class.h"

#include <algorithm>
#include <iterator>

#include <glog/logging.h>

namespace dhcal {
namespace {

struct ClassEntry {
  EffectClass effect_class;
  const char* name;
  const char* advice;
};

constexpr char kWiderRange[] = "poses over a wider range";

constexpr ClassEntry kClasses[] = {
    {EffectClass::kShoulderLoad,
     "C1",
     "a second target on the base or on link 2, or a load from the side"},
    {EffectClass::kShoulderAngle,
     "C2",
     "the full range of the joint; against gravity, the same poses with another payload"},
    {EffectClass::kJointAngle, "C3", "more than 180 deg of the joint's travel, wrist flips"},
    {EffectClass::kLostMotion,
     "C4",
     "approaches with another gravity load, other travel lengths, a longer dwell"},
    {EffectClass::kDrift,
     "C5",
     "reference poses repeated through the day, a target on the base, thermometers"},
    {EffectClass::kStep,
     "C6",
     "measured orientations, several arm shapes before and after the step"},
    {EffectClass::kLengthUnit, "C7", "a second length standard"},
    {EffectClass::kGearLine, "C8", "sidebands of the line, the gear's tooth and pole counts"},
    {EffectClass::kWristMotion, "C9", "wrist flips and turns of joints 4 and 6 beyond 180 deg"},
    {EffectClass::kElastic, "elastic", kWiderRange},
    {EffectClass::kCoupling, "coupling", kWiderRange},
    {EffectClass::kWobble, "wobble", kWiderRange},
    {EffectClass::kTiming, "timing", kWiderRange},
    {EffectClass::kGeometry, "geometry", kWiderRange},
};

const ClassEntry& EntryOf(EffectClass effect_class) {
  const auto* const found =
      std::find_if(std::begin(kClasses), std::end(kClasses), [&](const ClassEntry& entry) {
        return entry.effect_class == effect_class;
      });
  CHECK(found != std::end(kClasses));
  return *found;
}

}  // namespace

const char* ToString(EffectClass effect_class) { return EntryOf(effect_class).name; }

const char* Advice(EffectClass effect_class) { return EntryOf(effect_class).advice; }

EffectClass SmoothInAngleOf(int joint) {
  return joint == 2 ? EffectClass::kShoulderAngle : EffectClass::kJointAngle;
}

}  // namespace dhcal
