// Classes of effects that readings easily take for each other (physics.md A.10).
#ifndef DHCAL_CORE_PHYSICS_EFFECT_CLASS_H_
#define DHCAL_CORE_PHYSICS_EFFECT_CLASS_H_

namespace dhcal {

enum class EffectClass {
  kShoulderLoad,   // C1: yields under what the first loaded joint carries
  kShoulderAngle,  // C2: a smooth function of the shoulder's own angle
  kJointAngle,     // C3: a smooth function of another joint's own angle
  kLostMotion,     // C4
  kDrift,          // C5
  kStep,           // C6
  kLengthUnit,     // C7
  kGearLine,       // C8
  kWristMotion,    // C9
  kElastic,        // other loads
  kCoupling,       // other joints driven by one another
  kWobble,         // axes of other joints
  kTiming,
  kGeometry  // no physics: a freedom that the file holds fixed
};

/// "C1" ... "C9", "elastic", ..., "geometry".
const char* ToString(EffectClass effect_class);

/// What to measure to tell its members apart.
const char* Advice(EffectClass effect_class);

/// The class of a smooth function of a joint's own angle; `joint` counts from 1.
EffectClass SmoothInAngleOf(int joint);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_EFFECT_CLASS_H_
