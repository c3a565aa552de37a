#include "tools/proof/random_score.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "tools/proof/contradictions.h"
#include "tools/proof/json_numbers.h"

namespace dhcal {
namespace {

using Json = nlohmann::json;

constexpr double kSurePower = 0.95;  // a cause is detectable
constexpr double kShows = 0.05;      // physics of no library disturbs what else is named

/// Words (a column, a slot) say what a name speaks of and where.
bool SaysTheSameWords(const Json& name, const Json& cause) {
  const Json words = cause.value("words", Json::object());
  for (const auto& [key, word] : words.items()) {
    if (name.value(key, "") != word) return false;
  }
  return true;
}

/// A name (finding, alternative, member of a hypothesis) that is the cause's own, or one of those
/// that say the same of such readings. Settings of a name (orders, drivers, instants) do not count.
bool Names(const Json& name, const Json& cause) {
  const std::string effect = name.at("effect");
  const int joint = JointOf(name), place = JointOf(cause);
  const Json& also = cause.at("also");
  const bool alike =
      effect == cause.at("effect") || std::find(also.begin(), also.end(), effect) != also.end();
  if (alike && (place == 0 || joint == place) && SaysTheSameWords(name, cause)) return true;
  const Json& same = cause.at("same");
  return std::any_of(same.begin(), same.end(), [&](const Json& other) {
    return effect == other.at("effect") && (JointOf(other) == 0 || joint == JointOf(other));
  });
}

bool AnyNames(const Json& names, const Json& cause) {
  return std::any_of(names.begin(), names.end(), [&](const Json& name) {
    return name.contains("effect") && name.at("effect").is_string() && Names(name, cause);
  });
}

bool IsListed(const Json& diagnosis, const Json& cause) {
  for (const Json& finding : diagnosis.at("findings")) {
    if (Names(finding, cause) || AnyNames(finding.at("confusable_with"), cause)) return true;
  }
  const Json& hypotheses = diagnosis.at("hypotheses");
  return std::any_of(hypotheses.begin(), hypotheses.end(), [&](const Json& hypothesis) {
    return hypothesis.at("kept").get<bool>() && AnyNames(hypothesis.at("effects"), cause);
  });
}

bool IsAmong(const Json& causes, const Json& finding) {
  return std::any_of(
      causes.begin(), causes.end(), [&](const Json& cause) { return Names(finding, cause); });
}

/// A cause is among the alternatives of a name.
bool OffersTruth(const Json& answer, const Json& finding) {
  const Json& others = finding.at("confusable_with");
  return std::any_of(others.begin(), others.end(), [&](const Json& other) {
    return IsAmong(answer.at("causes"), other);
  });
}

/// Geometry that is off: as put in; or of each run, where the instrument was set up anew.
bool IsOff(const Json& answer, const Json& finding) {
  const std::string effect = finding.at("effect");
  const Json& geometry = answer.at("geometry");
  if (std::find(geometry.begin(), geometry.end(), effect) != geometry.end()) return true;
  const Json& causes = answer.at("causes");
  const bool moved = std::any_of(causes.begin(), causes.end(), [](const Json& cause) {
    return cause.at("effect") == "base_per_run";
  });
  // A base that differs between runs is off in the mean of them.
  return IsAmong(causes, finding) || (moved && effect == "base_frame");
}

std::string Words(const Json& finding) {
  std::string words =
      fmt::format("{}.{}", finding.at("effect").get<std::string>(), JointOf(finding));
  for (const Json& other : finding.at("confusable_with")) {
    words += fmt::format(" | {}.{}", other.at("effect").get<std::string>(), JointOf(other));
  }
  return words;
}

void ScoreCauses(const Json& answer, const Json& diagnosis, RandomScore* score) {
  for (const Json& cause : answer.at("causes")) {
    CauseScore one;
    one.effect = cause.at("effect");
    one.joint = JointOf(cause);
    one.visible = NumberOr(cause, "visible_sigmas", 0);
    one.power = NumberOr(cause, "power", 0);
    one.detectable = one.power > kSurePower && !one.effect.empty();
    one.named = AnyNames(diagnosis.at("findings"), cause);
    one.listed = IsListed(diagnosis, cause);
    score->outside = score->outside || (one.effect.empty() && one.power > kShows);
    score->causes.push_back(one);
  }
}

bool AllDetectable(const RandomScore& score, const std::function<bool(const CauseScore&)>& hold) {
  return std::all_of(score.causes.begin(), score.causes.end(), [&](const CauseScore& cause) {
    return !cause.detectable || hold(cause);
  });
}

bool Any(const RandomScore& score, const std::function<bool(const CauseScore&)>& holds) {
  return std::any_of(score.causes.begin(), score.causes.end(), holds);
}

void ScoreRandomNames(const Json& answer, const Json& diagnosis, RandomScore* score) {
  bool not_there = false, superfluous = false, single = false, physics = false;
  for (const Json& finding : diagnosis.at("findings")) {
    score->findings.push_back(Words(finding));
    const bool offers = OffersTruth(answer, finding);
    if (finding.at("class") == "geometry") {
      score->geometry_extra = score->geometry_extra || !(offers || IsOff(answer, finding));
      continue;
    }
    physics = true;
    if (IsAmong(answer.at("causes"), finding)) continue;
    not_there = true;
    single = single || finding.at("confusable_with").empty();
    superfluous = superfluous || !offers;
  }
  const auto is_named = [](const CauseScore& cause) { return cause.named; };
  const auto is_listed = [](const CauseScore& cause) { return cause.listed; };
  const bool seen = Any(*score, [](const CauseScore& cause) { return cause.detectable; });
  score->null = score->causes.empty();
  score->judged = seen && !score->outside;
  score->listed = AllDetectable(*score, is_listed);
  score->alone = AllDetectable(*score, is_named) && !not_there;
  const bool truth = seen ? score->listed : Any(*score, is_listed);
  score->wrong_single = !score->null && single && !truth;
  score->extra = score->judged && superfluous && truth;
  const bool geometry_only =
      !score->geometry.empty() && !physics && score->verdict != "unexplained";
  score->false_alarm = score->null && score->verdict != "consistent" && !geometry_only;
}

}  // namespace

double RandomScore::weakest() const {
  double weakest = std::numeric_limits<double>::infinity();
  for (const CauseScore& cause : causes) {
    if (cause.detectable) weakest = std::min(weakest, cause.visible);
  }
  return weakest;
}

RandomScore ScoreRandomCase(const Json& answer, const Json& result) {
  RandomScore score;
  score.name = answer.at("name");
  score.seed = answer.at("seed");
  score.settings = answer.at("settings").get<std::map<std::string, std::string>>();
  score.geometry = answer.at("geometry").get<std::vector<std::string>>();
  if (!result.contains("diagnosis")) {
    score.failure = "no diagnosis in result.json";
    return score;
  }
  const Json& diagnosis = result.at("diagnosis");
  score.verdict = diagnosis.at("verdict");
  if (score.verdict == "failed") score.failure = "the diagnosis failed";
  score.seconds = NumberOr(diagnosis, "seconds", score.seconds);
  const Json& hypotheses = diagnosis.at("hypotheses");
  score.kept =
      static_cast<int>(std::count_if(hypotheses.begin(), hypotheses.end(), [](const auto& h) {
        return h.at("kept").template get<bool>();
      }));
  score.contradictions = ContradictionsIn(diagnosis);
  ScoreCauses(answer, diagnosis, &score);
  ScoreRandomNames(answer, diagnosis, &score);
  return score;
}

nlohmann::ordered_json RandomScoreToJson(const RandomScore& s) {
  nlohmann::ordered_json causes = nlohmann::ordered_json::array();
  for (const CauseScore& cause : s.causes) {
    causes.push_back({{"effect", cause.effect},
                      {"joint", cause.joint},
                      {"visible_sigmas", cause.visible},
                      {"power", cause.power},
                      {"detectable", cause.detectable},
                      {"named", cause.named},
                      {"listed", cause.listed}});
  }
  return {{"name", s.name},
          {"seed", s.seed},
          {"failure", s.failure},
          {"settings", s.settings},
          {"causes", causes},
          {"geometry", s.geometry},
          {"verdict", s.verdict},
          {"findings", s.findings},
          {"contradictions", s.contradictions},
          {"hypotheses_kept", s.kept},
          {"seconds", s.seconds},
          {"null", s.null},
          {"outside", s.outside},
          {"judged", s.judged},
          {"right_alone", s.alone},
          {"right_or_listed", s.listed},
          {"wrong_single", s.wrong_single},
          {"extra", s.extra},
          {"geometry_extra", s.geometry_extra},
          {"false_alarm", s.false_alarm}};
}

}  // namespace dhcal
