// Holds what a diagnosis said against the sealed answer.
#ifndef DHCAL_TOOLS_PROOF_SCORE_H_
#define DHCAL_TOOLS_PROOF_SCORE_H_

#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace dhcal {

/// Of one case. Lengths in metres; NaN = does not apply.
struct ProofScore {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string name, scenario, story, group, robot;
  int seed = 0;
  std::string failure;  // "" = the program ended with a usable result
  std::string verdict;
  std::vector<std::string> findings;  // physics only, "backlash.4"
  double p_value = kNone;
  double seconds = kNone;

  bool library_has_all = false;
  bool detectable = false;  // a test that knows each cause would see one with power above 0.95
  bool all_detectable = false;
  bool detected = false;      // the verdict is not `consistent`, or physics is named
  bool false_alarm = false;   // physics or `unexplained` where there is none
  bool truth_kept = false;    // no sound hypothesis was excluded
  bool named = false;         // every detectable cause at class and joint, and nothing else
  bool place_right = false;   // every detectable cause's place is among those named or listed
  bool wrong_single = false;  // a name alone, without alternatives, that is wrong
  bool unexplained_at_slot = false;  // outside the library: put at the right place without a name
  int intervals = 0, covered = 0;
  double noise = kNone, rms_before = kNone, rms_after = kNone, rms_oracle = kNone;  // unseen rows
  double largest_elsewhere = kNone;  // true error elsewhere of a rigid fit
  double risk = kNone;               // what the report warned of
  bool warned = false;               // named, listed, or the risk covers it
};

/// `answer`: the sealed answer; `result`, `oracle`: result.json of the program and of the fit that
/// was told the truth (null where the library lacks a cause).
ProofScore ScoreCase(const nlohmann::json& answer,
                     const nlohmann::json& result,
                     const nlohmann::json& oracle);

nlohmann::ordered_json ScoreToJson(const ProofScore& score);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_SCORE_H_
