#include "tools/proof/score.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tools/proof/json_numbers.h"

namespace dhcal {
namespace {

using Json = nlohmann::json;

constexpr double kDetectablePower = 0.95;
constexpr double kSameOrder = 0.3;  // lines per turn

/// A name (finding, alternative or member of a hypothesis) that is the cause's own.
bool IsCause(const Json& effect, const Json& cause) {
  const std::string name = effect.at("effect");
  const Json& settings = cause.at("settings");
  const bool same = name == cause.at("effect");
  const Json& also = cause.at("also");
  const bool alike = std::find(also.begin(), also.end(), name) != also.end();
  if ((!same && !alike) || JointOf(effect) != JointOf(cause)) return false;
  if (!same) return true;
  if (settings.contains("driver_joint") &&
      NumberOr(effect, "driver_joint", 0) != settings.at("driver_joint").get<double>()) {
    return false;
  }
  if (NumberOr(effect, "laser", 0) != NumberOr(settings, "laser", 0)) return false;
  const double order = NumberOr(settings, "order", 0);
  // Over a limited range the low orders of a gear are one smooth curve.
  constexpr double kSmooth = 2.5;
  const double found = NumberOr(effect, "order", 0);
  if (order > 0 && order < kSmooth && found < kSmooth) return true;
  return std::abs(found - order) < kSameOrder;
}

/// The cause is named, listed as an alternative, or its class at its place is.
bool Answers(const Json& finding, const Json& cause) {
  if (IsCause(finding, cause)) return true;
  for (const Json& other : finding.at("confusable_with")) {
    if (IsCause(other, cause)) return true;
  }
  return !cause.at("class").get<std::string>().empty() &&
         finding.at("class") == cause.at("class") && finding.at("location") == cause.at("location");
}

bool PointsTo(const Json& finding, const Json& cause) {
  if (finding.at("location") == cause.at("location")) return true;
  const Json& others = finding.at("confusable_with");
  return std::any_of(others.begin(), others.end(), [&](const Json& other) {
    return other.at("location") == cause.at("location");
  });
}

bool IsDetectable(const Json& cause) { return NumberOr(cause, "power", 0) > kDetectablePower; }

/// The detectable causes are all in the hypothesis, and nothing that is none.
bool HoldsTruth(const Json& hypothesis, const Json& causes) {
  const Json& effects = hypothesis.at("effects");
  const auto is_one = [&](const Json& effect) {
    return std::any_of(
        causes.begin(), causes.end(), [&](const Json& cause) { return IsCause(effect, cause); });
  };
  if (!std::all_of(effects.begin(), effects.end(), is_one)) return false;
  return std::all_of(causes.begin(), causes.end(), [&](const Json& cause) {
    return !IsDetectable(cause) || std::any_of(effects.begin(), effects.end(), [&](const Json& e) {
      return IsCause(e, cause);
    });
  });
}

void ScoreIntervals(const Json& finding, const Json& causes, ProofScore* score) {
  for (const Json& cause : causes) {
    if (finding.at("effect") != cause.at("effect") || !IsCause(finding, cause)) continue;
    if (NumberOr(finding, "order", 0) != NumberOr(cause.at("settings"), "order", 0)) continue;
    for (const Json& parameter : finding.at("parameters")) {
      const std::string name = parameter.at("name");
      const auto value = cause.at("values").find(name.substr(name.rfind('.') + 1));
      if (value == cause.at("values").end() || !parameter.contains("ci95")) continue;
      const double truth = value->get<double>();
      ++score->intervals;
      const Json& interval = parameter.at("ci95");
      const bool inside = interval[0].get<double>() <= truth && truth <= interval[1].get<double>();
      score->covered += inside ? 1 : 0;
    }
  }
}

/// What the report warned of for a cause, or for anything.
double RiskOf(const Json& diagnosis, const Json& causes) {
  double own = 0, largest = 0;
  for (const Json& hidden : diagnosis.at("hidden")) {
    const double risk = NumberOr(hidden, "risk_elsewhere_m", 0);
    largest = std::max(largest, risk);
    for (const Json& cause : causes) {
      if (IsCause(hidden, cause)) own = std::max(own, risk);
    }
  }
  return own > 0 ? own : largest;
}

double UnseenRms(const Json& result) {
  if (!result.contains("validation")) return ProofScore::kNone;
  return NumberOr(result.at("validation"), "rms_test_m", ProofScore::kNone);
}

void ScoreNames(const std::vector<Json>& physics, const Json& causes, ProofScore* score) {
  const auto answered = [&](const Json& cause) {
    return std::any_of(physics.begin(), physics.end(), [&](const Json& finding) {
      return Answers(finding, cause);
    });
  };
  const auto located = [&](const Json& cause) {
    return std::any_of(physics.begin(), physics.end(), [&](const Json& finding) {
      return PointsTo(finding, cause);
    });
  };
  score->named = !causes.empty();
  score->place_right = !causes.empty();
  for (const Json& cause : causes) {
    if (!IsDetectable(cause)) continue;
    score->named = score->named && answered(cause);
    score->place_right = score->place_right && located(cause);
  }
  for (const Json& finding : physics) {
    const bool right = std::any_of(
        causes.begin(), causes.end(), [&](const Json& cause) { return Answers(finding, cause); });
    if (right) continue;
    score->named = false;
    score->wrong_single = score->wrong_single || finding.at("confusable_with").empty();
  }
}

void ScoreDiagnosis(const Json& answer, const Json& d, ProofScore* score) {
  const Json& causes = answer.at("causes");
  score->verdict = d.at("verdict");
  score->p_value = NumberOr(d.at("misfit"), "p_value", ProofScore::kNone);
  score->seconds = NumberOr(d, "seconds", ProofScore::kNone);
  std::vector<Json> physics;
  for (const Json& finding : d.at("findings")) {
    if (finding.at("class") == "geometry") continue;
    physics.push_back(finding);
    std::string name =
        fmt::format("{}.{}", finding.at("effect").get<std::string>(), JointOf(finding));
    if (finding.contains("order")) name += fmt::format(" x{:g}", finding.at("order").get<double>());
    for (const Json& other : finding.at("confusable_with")) {
      name += fmt::format(" | {}.{}", other.at("effect").get<std::string>(), JointOf(other));
    }
    score->findings.push_back(name);
    ScoreIntervals(finding, causes, score);
  }
  const bool only_geometry =
      physics.empty() && !d.at("findings").empty() && score->verdict != "unexplained";
  score->detected = score->verdict != "consistent" && !only_geometry;
  score->false_alarm = causes.empty() && score->detected;
  ScoreNames(physics, causes, score);
  if (!score->detected) {
    score->truth_kept = !score->all_detectable || causes.empty();
  } else {
    for (const Json& hypothesis : d.at("hypotheses")) {
      score->truth_kept = score->truth_kept ||
                          (hypothesis.at("kept").get<bool>() && HoldsTruth(hypothesis, causes));
    }
  }
  if (d.contains("unexplained") && !causes.empty()) {
    const std::string slot = d.at("unexplained").at("slot");
    score->unexplained_at_slot = score->verdict == "unexplained" &&
                                 slot.rfind(causes[0].at("slot").get<std::string>(), 0) == 0;
  }
  if (std::isfinite(score->largest_elsewhere)) {
    score->risk = RiskOf(d, causes);
    const bool listed = std::any_of(physics.begin(), physics.end(), [&](const Json& finding) {
      return Answers(finding, causes[0]);
    });
    score->warned =
        listed || (score->detected && score->truth_kept) || score->risk >= score->largest_elsewhere;
  }
  score->rms_before = NumberOr(d, "rms_test_before_m", score->rms_before);
  score->rms_after = NumberOr(d, "rms_test_after_m", score->rms_after);
}

}  // namespace

ProofScore ScoreCase(const Json& answer, const Json& result, const Json& oracle) {
  ProofScore score;
  score.name = answer.at("name");
  score.scenario = answer.at("scenario");
  score.story = answer.at("story");
  score.group = answer.at("group");
  score.robot = answer.at("robot");
  score.seed = answer.at("seed");
  score.noise = answer.at("noise_m");
  score.largest_elsewhere = NumberOr(answer, "largest_elsewhere_m", ProofScore::kNone);
  const Json& causes = answer.at("causes");
  score.library_has_all = std::none_of(causes.begin(), causes.end(), [](const Json& cause) {
    return cause.at("effect").get<std::string>().empty();
  });
  score.detectable = std::any_of(causes.begin(), causes.end(), IsDetectable);
  score.all_detectable = !causes.empty() && std::all_of(causes.begin(), causes.end(), IsDetectable);
  if (!result.contains("diagnosis")) {
    score.failure = "no diagnosis in result.json";
    return score;
  }
  score.rms_before = score.rms_after = UnseenRms(result);
  if (!oracle.is_null()) score.rms_oracle = UnseenRms(oracle);
  ScoreDiagnosis(answer, result.at("diagnosis"), &score);
  return score;
}

nlohmann::ordered_json ScoreToJson(const ProofScore& s) {
  nlohmann::ordered_json object = {{"name", s.name},
                                   {"scenario", s.scenario},
                                   {"group", s.group},
                                   {"robot", s.robot},
                                   {"seed", s.seed},
                                   {"failure", s.failure},
                                   {"verdict", s.verdict},
                                   {"findings", s.findings},
                                   {"p_value", s.p_value},
                                   {"seconds", s.seconds},
                                   {"library_has_all", s.library_has_all},
                                   {"detectable", s.detectable},
                                   {"all_detectable", s.all_detectable},
                                   {"detected", s.detected},
                                   {"false_alarm", s.false_alarm},
                                   {"truth_kept", s.truth_kept},
                                   {"named", s.named},
                                   {"place_right", s.place_right},
                                   {"wrong_single", s.wrong_single},
                                   {"unexplained_at_slot", s.unexplained_at_slot},
                                   {"intervals", s.intervals},
                                   {"covered", s.covered},
                                   {"noise_m", s.noise},
                                   {"rms_test_before_m", s.rms_before},
                                   {"rms_test_after_m", s.rms_after},
                                   {"rms_test_oracle_m", s.rms_oracle},
                                   {"largest_elsewhere_m", s.largest_elsewhere},
                                   {"risk_m", s.risk},
                                   {"warned", s.warned}};
  return object;
}

}  // namespace dhcal
