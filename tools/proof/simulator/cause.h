// A cause as scenarios and random trials put it in, and how the effect library calls it.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_CAUSE_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_CAUSE_H_

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/proof/simulator/physics.h"
#include "tools/proof/simulator/visibility.h"

namespace dhcal::concealed {

/// A cause that is put in, in the words of FORMATS.md.
struct Cause {
  std::string effect;                              // "" = nothing in the library is like it
  int joint = 0;                                   // from 1; 0 = none
  std::map<std::string, double> settings, values;  // values that an interval should hold
  std::map<std::string, std::string> words;        // settings that are words
  std::string effect_class, location;
  std::string slot;    // where it acts, in the words of the mismatch map
  int parameters = 1;  // that describe it
  std::string more;    // further effects of the oracle's problem file, as YAML
  /// Wrong masses in the file could look like it: only what they cannot imitate counts as visible.
  bool like_masses = false;
  /// Names that mean the same on such data ("joint_gain" of the same joint, for one).
  std::vector<std::string> also;
  /// Effects elsewhere that move the measured point alike (0 = no joint).
  std::vector<std::pair<std::string, int>> same;
  /// Puts it in, `scale` times.
  std::function<void(Physics*, double scale)> apply;
  Visibility visibility;
};

/// A cause at a joint (from 1), with nothing set yet.
Cause NamedCause(const std::string& effect, int joint, const std::string& effect_class);

/// The same, acting elsewhere than at the joint's angle.
Cause At(Cause cause, const std::string& location, const std::string& slot);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_CAUSE_H_
