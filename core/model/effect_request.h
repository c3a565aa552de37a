// A physical effect that a problem file or the diagnosis switches on.
#ifndef DHCAL_CORE_MODEL_EFFECT_REQUEST_H_
#define DHCAL_CORE_MODEL_EFFECT_REQUEST_H_

#include <map>
#include <string>

#include "core/base/diagnostics.h"

namespace dhcal {

/// Which effect of the library (core/physics/registry.h), where, and the numbers that fix its
/// shape. Its parameters are estimated; its settings are not.
struct EffectRequest {
  std::string effect;                        // "gear_harmonic"
  int joint = 0;                             // counts from 1; 0 = the effect has no joint
  std::map<std::string, double> settings;    // "order", "time_constant_s", ... in SI
  std::map<std::string, std::string> words;  // settings that are words: "column", "slot"
  std::map<std::string, double> values;      // parameter -> value in SI: simulated, or held
  bool held = false;  // in a fit: `values` are used as they are (0 where none), not estimated
  SourceLocation where;

  double setting(const std::string& name, double otherwise) const {
    const auto found = settings.find(name);
    return found == settings.end() ? otherwise : found->second;
  }
  std::string word(const std::string& name) const {
    const auto found = words.find(name);
    return found == words.end() ? "" : found->second;
  }
  /// True for the same effect at the same place with the same settings.
  bool SameAs(const EffectRequest& other) const {
    return effect == other.effect && joint == other.joint && settings == other.settings &&
           words == other.words;
  }
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_EFFECT_REQUEST_H_
