// What the random group came to, as text.
#ifndef DHCAL_TOOLS_PROOF_RANDOM_TABLE_H_
#define DHCAL_TOOLS_PROOF_RANDOM_TABLE_H_

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tools/proof/random_score.h"

namespace dhcal {

/// One rate that the random group is judged by.
struct RandomRate {
  std::string name, title;
  int hits = 0, trials = 0;
  double bar = 0;
  bool at_most = true;

  bool reached() const;
};

std::vector<RandomRate> RandomRates(const std::vector<RandomScore>& scores);

/// Rates with their bars, then by setting, strength and cause, all with Wilson intervals of 95 %.
std::string RandomTable(const std::vector<RandomScore>& scores);

nlohmann::ordered_json RandomRatesToJson(const std::vector<RandomRate>& rates);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_RANDOM_TABLE_H_
