// What no result.json may say: parts of a diagnosis that contradict each other.
#ifndef DHCAL_TOOLS_PROOF_CONTRADICTIONS_H_
#define DHCAL_TOOLS_PROOF_CONTRADICTIONS_H_

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace dhcal {

/// A sentence each, from the key `diagnosis`. Written apart from the program's own checks, and from
/// what is printed, so that what is lost on the way to the file shows, too.
std::vector<std::string> ContradictionsIn(const nlohmann::json& diagnosis);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_CONTRADICTIONS_H_
