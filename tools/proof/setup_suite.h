// The group of wrong set-ups: recordings whose files say something that is not so, beside random
// trials whose files are right. Does the program say what is wrong, and accuse no right file?
#ifndef DHCAL_TOOLS_PROOF_SETUP_SUITE_H_
#define DHCAL_TOOLS_PROOF_SETUP_SUITE_H_

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tools/proof/suite.h"

namespace dhcal {

struct SetupScore {
  std::string name, robot, kind;      // kind of reading
  std::string failure;                // "" = the program ended with a result
  std::vector<std::string> mistakes;  // "joint_sense 2 6"
  std::vector<std::string> claimed;   // of the first alternative
  int alternatives = 0;
  bool plausible = true;
  /// The first alternative names what is wrong, or fits as well with no more causes: base and tool
  /// then absorb the difference.
  bool right = false;
  bool listed = false;         // an alternative does
  bool claimed_wrong = false;  // one alternative, and it is not right
  bool accused = false;        // right files that are called implausible, or are given a cause
  double seconds = 0;
};

/// Cases of seeds `options.first` on: `options.setups` with mistakes and as many right ones.
std::vector<SetupScore> RunSetupProof(const ProofOptions& options,
                                      const std::function<void(int done, int all)>& say);

/// Holds an answer of the program against the sealed one; `right_rms` [m]: base and tool fitted
/// with the files as they should be.
SetupScore ScoreSetup(const nlohmann::json& answer, const nlohmann::json& result, double right_rms);

std::string SetupTable(const std::vector<SetupScore>& scores);
nlohmann::ordered_json SetupScoreToJson(const SetupScore& score);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_SETUP_SUITE_H_
