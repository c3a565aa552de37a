// Numbers of answers and results that may be absent.
#ifndef DHCAL_TOOLS_PROOF_JSON_NUMBERS_H_
#define DHCAL_TOOLS_PROOF_JSON_NUMBERS_H_

#include <nlohmann/json.hpp>

namespace dhcal {

inline double NumberOr(const nlohmann::json& object, const char* key, double fallback) {
  const auto found = object.find(key);
  return found == object.end() || !found->is_number() ? fallback : found->get<double>();
}

/// From 1; 0 = of no joint.
inline int JointOf(const nlohmann::json& effect) {
  return static_cast<int>(NumberOr(effect, "joint", 0));
}

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_JSON_NUMBERS_H_
