#include "tools/plan/split_run.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/report/format.h"
#include "problems/diagnosis/calibrate.h"
#include "problems/formats/result/result_reader.h"

namespace dhcal {
namespace {

using Json = nlohmann::json;

// Two alternatives so many standard deviations apart are named apart in nearly all draws.
constexpr double kApart = 4;

EffectRequest EffectOf(const Json& object) {
  EffectRequest effect;
  for (const auto& [key, value] : object.items()) {
    if (key == "effect") {
      effect.effect = value.get<std::string>();
    } else if (key == "joint") {
      effect.joint = value.is_null() ? 0 : value.get<int>();
    } else if (value.is_string()) {
      effect.words[key] = value.get<std::string>();
    } else {
      effect.settings[key] = value.get<double>();
    }
  }
  return effect;
}

std::vector<HypothesisResult> HypothesesOf(const Json& diagnosis) {
  std::vector<HypothesisResult> hypotheses;
  for (const Json& entry : diagnosis.at("hypotheses")) {
    HypothesisResult& hypothesis = hypotheses.emplace_back();
    hypothesis.kept = entry.at("kept").get<bool>();
    for (const Json& effect : entry.at("effects")) hypothesis.effects.push_back(EffectOf(effect));
  }
  return hypotheses;
}

/// The worse of the two directions of every pair.
Table PairTable(const SplitPlan& plan) {
  constexpr auto kRight = Table::Align::kRight;
  Table table;
  table.title = "How far apart, in standard deviations of the readings' noise";
  table.columns = {{"alternatives", "", 80, Table::Align::kLeft},
                   {"now", "", 8, kRight},
                   {"with the poses", "", 14, kRight}};
  for (const SplitPair& pair : plan.pairs) {
    if (!(pair.truth < pair.other)) continue;
    SplitPair worst = pair;
    for (const SplitPair& back : plan.pairs) {
      if (back.truth != pair.other || back.other != pair.truth) continue;
      worst.before = std::min(worst.before, back.before);
      worst.after = std::min(worst.after, back.after);
    }
    table.AddRow({pair.truth + " or " + pair.other,
                  fmt::format("{:.1f}", worst.before),
                  fmt::format("{:.1f}", worst.after)});
  }
  return table;
}

}  // namespace

std::optional<std::vector<Alternative>> ReadAlternatives(const std::string& result_json,
                                                         Diagnostics* diagnostics) {
  if (!std::ifstream(result_json)) {
    diagnostics->Error({result_json}, "cannot be opened; give the result.json of a result folder");
    return std::nullopt;
  }
  std::optional<std::vector<Alternative>> alternatives;
  TakeFromResult(
      result_json,
      [&](const Json& root) {
        if (root.contains("diagnosis")) {
          alternatives = AlternativesOf(HypothesesOf(root.at("diagnosis")));
        } else {
          diagnostics->Error({result_json}, "has no diagnosis; run ceres_dhcal with one");
        }
      },
      diagnostics);
  return alternatives;
}

std::vector<Alternative> DiagnosedAlternatives(const ProblemSpec& spec, const Recording& own) {
  const Result result = Calibrate(spec, own, {});
  if (!result.diagnosis) return {};
  return AlternativesOf(result.diagnosis->hypotheses);
}

Document SplitReport(const ProblemSpec& spec, const SplitPlan& plan, const std::string& out) {
  Document document;
  document.title = "Poses that split alternatives: " + spec.name;
  document.program = "dhcal_plan " DHCAL_VERSION;
  double least = HUGE_VAL;
  for (const SplitPair& pair : plan.pairs) least = std::min(least, pair.after);
  Paragraph words;
  words.lines.push_back(fmt::format(
      "{} of {}, measured in addition to the recording. {}",
      Counted(static_cast<int>(plan.rows.q.rows()), "pose"),
      out,
      least >= kApart
          ? "Then all pairs stand clearly apart."
          : fmt::format("The nearest pair then is {:.1f} apart; from {:.0f} on a name is nearly "
                        "certain, so more poses may be needed.",
                        least,
                        kApart)));
  if (plan.rows.direction.rows() > 0) {
    words.lines.emplace_back(
        "dir1 ...: approach each pose with the last motion of every joint in that sense.");
  }
  if (plan.rows.payload.size() > 0) words.lines.emplace_back("payload_kg: carry that load there.");
  words.lines.insert(words.lines.end(), plan.notes.begin(), plan.notes.end());
  words.lines.emplace_back("Check every pose for collisions and for the instrument's sight.");
  document.sections.push_back({"", {PairTable(plan), words}});
  return document;
}

}  // namespace dhcal
