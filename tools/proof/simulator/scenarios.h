// The scenarios D1 to D23 and more decoys, as trials. Each tells its story in one line.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_SCENARIOS_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_SCENARIOS_H_

#include <cstdint>
#include <string>
#include <vector>

#include "tools/proof/simulator/trial.h"

namespace dhcal::concealed {

struct Scenario {
  std::string name;   // "D4"
  std::string story;  // one line
  Group group = Group::kSingle;
  bool quick = false;  // one of its trials belongs to the quick suite
  int most_seeds = 1000;
  void (*set_up)(Trial*, Rng*) = nullptr;
};

const std::vector<Scenario>& AllScenarios();

/// Those of a measuring head over straight edges.
const std::vector<Scenario>& HeadScenarios();

/// A trial of a scenario: the robot goes with the seed (KR 15, UR10, small arm in turn).
Trial MakeTrial(const Scenario& scenario, int seed);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_SCENARIOS_H_
