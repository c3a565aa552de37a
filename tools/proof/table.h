// What the whole suite came to, as text and as JSON.
#ifndef DHCAL_TOOLS_PROOF_TABLE_H_
#define DHCAL_TOOLS_PROOF_TABLE_H_

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tools/proof/score.h"

namespace dhcal {

/// One figure that the suite is judged by.
struct ProofFigure {
  std::string name;   // "false_alarm_rate"
  std::string title;  // "false alarms where nothing is left out"
  double value = ProofScore::kNone;
  double bar = ProofScore::kNone;
  bool at_most = true;
  int cases = 0;  // it rests on
  bool percent = true;

  bool reached() const { return cases == 0 || (at_most ? value <= bar : value >= bar); }
};

std::vector<ProofFigure> Figures(const std::vector<ProofScore>& scores);

/// A line per scenario, then the figures with their bars.
std::string ProofTable(const std::vector<ProofScore>& scores);

nlohmann::ordered_json FiguresToJson(const std::vector<ProofFigure>& figures);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_TABLE_H_
