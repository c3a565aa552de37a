// What the random group came to, as text.
#ifndef DHCAL_TOOLS_PROOF_RANDOM_TABLE_H_
#define DHCAL_TOOLS_PROOF_RANDOM_TABLE_H_

#include <string>
#include <vector>

#include "tools/proof/random_score.h"

namespace dhcal {

/// Rates with their bars, then by setting, strength and cause, all with Wilson intervals of 95 %.
std::string RandomTable(const std::vector<RandomScore>& scores);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_RANDOM_TABLE_H_
