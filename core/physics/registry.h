// The library of effects. A new effect is one file in core/physics/effects and one line in the
// list of registry.cc.
#ifndef DHCAL_CORE_PHYSICS_REGISTRY_H_
#define DHCAL_CORE_PHYSICS_REGISTRY_H_

#include <optional>
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

std::vector<std::string> EffectNames();

struct WholeRange {
  int low = 0;
  int high = 0;
};

/// What a setting of this name may be where it counts something or switches it on (1) or off (0);
/// nothing where it may be any number.
std::optional<WholeRange> WholeSetting(const std::string& setting, int num_joints);

/// True if a setting of this name is a word: the name of a column, of a slot.
bool IsWord(const std::string& setting);

/// Columns of a request's effect; the effect must exist and be testable.
std::vector<EffectColumn> EffectColumns(const PhysicsContext& context,
                                        const EffectRequest& request);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_REGISTRY_H_
