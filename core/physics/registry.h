// The library of effects. A new effect is one file in core/physics/effects and one line in the
// list of registry.cc.
#ifndef DHCAL_CORE_PHYSICS_REGISTRY_H_
#define DHCAL_CORE_PHYSICS_REGISTRY_H_

#include <string>
#include <vector>

#include "core/physics/effect.h"

namespace dhcal {

/// All effects, in the order of the list.
const std::vector<const Effect*>& AllEffects();

/// Null when there is none of this name.
const Effect* FindEffect(const std::string& name);

/// The library's free curve of a joint's angle.
const Effect& CurveEffect();

/// The effect that a line of the spectrum of a joint's angle is, and a request of it.
const Effect& LineEffect();
EffectRequest Line(int joint, double order);

/// The effect that stands for a group of geometric parameters where a file leaves them out; null
/// where there is none.
const Effect* EffectThatCompletes(ParameterGroup group);

std::vector<std::string> EffectNames();

/// Columns of a request's effect; the effect must exist and be testable.
std::vector<EffectColumn> EffectColumns(const PhysicsContext& context,
                                        const EffectRequest& request);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_REGISTRY_H_
