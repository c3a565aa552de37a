// The mistakes that files are given, one by one.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_SETUPS_MISTAKES_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_SETUPS_MISTAKES_H_

#include <functional>
#include <string>
#include <vector>

#include "core/base/rng.h"
#include "tools/proof/simulator/setups/wrong_files.h"

namespace dhcal::concealed {

struct MistakeSource {
  std::string kind;
  bool possible = true;
  /// Makes it and writes it down.
  std::function<void(WrongFiles*, Rng*)> make;
};

/// Those that these files can have; each once. They are made in this order: what is said of joints
/// before their columns change places.
std::vector<MistakeSource> MistakeSources(const WrongFiles& files);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_SETUPS_MISTAKES_H_
