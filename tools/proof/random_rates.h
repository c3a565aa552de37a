// The rates that the random group is judged by.
#ifndef DHCAL_TOOLS_PROOF_RANDOM_RATES_H_
#define DHCAL_TOOLS_PROOF_RANDOM_RATES_H_

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tools/proof/random_score.h"

namespace dhcal {

/// Some of the scores, and those of them that a condition picks.
using RandomScores = std::vector<const RandomScore*>;
using RandomCondition = std::function<bool(const RandomScore&)>;

/// Those that ended with a usable result.
RandomScores Ended(const std::vector<RandomScore>& scores);
RandomScores Those(const RandomScores& scores, const RandomCondition& in);
int Count(const RandomScores& scores, const RandomCondition& holds);

/// One rate that the random group is judged by.
struct RandomRate {
  std::string name, title;
  int hits = 0, trials = 0;
  double bar = 0;
  bool at_most = true;

  bool reached() const;
};

std::vector<RandomRate> RandomRates(const std::vector<RandomScore>& scores);

nlohmann::ordered_json RandomRatesToJson(const std::vector<RandomRate>& rates);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_RANDOM_RATES_H_
