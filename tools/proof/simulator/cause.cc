#include "tools/proof/simulator/cause.h"

#include <fmt/format.h>

namespace dhcal::concealed {

Cause NamedCause(const std::string& effect, int joint, const std::string& effect_class) {
  Cause cause;
  cause.effect = effect;
  cause.joint = joint;
  cause.effect_class = effect_class;
  cause.location = fmt::format("joint {}", joint);
  cause.slot = fmt::format("theta{}", joint);
  return cause;
}

Cause At(Cause cause, const std::string& location, const std::string& slot) {
  cause.location = location;
  cause.slot = slot;
  return cause;
}

}  // namespace dhcal::concealed
