// Holds what a diagnosis said of a random trial against the sealed answer.
#ifndef DHCAL_TOOLS_PROOF_RANDOM_SCORE_H_
#define DHCAL_TOOLS_PROOF_RANDOM_SCORE_H_

#include <limits>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace dhcal {

/// One cause of a random trial, and what became of it.
struct CauseScore {
  std::string effect;  // "" = in no library
  int joint = 0;
  double visible = 0;  // RMS over the noise, beside geometry and the other causes
  double power = 0;
  bool detectable = false;
  bool named = false;   // among the findings
  bool listed = false;  // or among their alternatives or the hypotheses that are kept
};

struct RandomScore {
  std::string name;
  int seed = 0;
  std::string failure;  // "" = the program ended with a usable result
  std::map<std::string, std::string> settings;
  std::vector<CauseScore> causes;
  std::vector<std::string> geometry;  // that is off while the file holds it fixed
  std::string verdict;
  std::vector<std::string> findings;  // "backlash.4 | joint_gain.4", geometry among them
  std::vector<std::string> contradictions;
  int kept = 0;  // hypotheses
  double seconds = std::numeric_limits<double>::quiet_NaN();

  bool null = false;            // nothing is left out
  bool outside = false;         // physics of no library shows
  bool judged = false;          // some cause of the library is detectable, and none outside shows
  bool alone = false;           // every detectable cause is named, and no physics that is not there
  bool listed = false;          // every detectable cause is named or listed
  bool wrong_single = false;    // a wrong name without alternatives, and the truth is not listed
  bool extra = false;           // a name beside the truth that neither is there nor offers it
  bool geometry_extra = false;  // geometry is named that the file frees, or that is as stated
  bool false_alarm = false;     // where nothing is left out

  /// Visible RMS over the noise of the weakest detectable cause.
  double weakest() const;
};

RandomScore ScoreRandomCase(const nlohmann::json& answer, const nlohmann::json& result);

nlohmann::ordered_json RandomScoreToJson(const RandomScore& score);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_RANDOM_SCORE_H_
