#include "tools/proof/random_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include <fmt/format.h>

#include "tools/proof/random_rates.h"
#include "tools/proof/wilson.h"

namespace dhcal {
namespace {

const char* StrengthOf(const RandomScore& score) {
  const double visible = score.weakest();
  return visible < 0.3  ? "rms/sigma below 0.3"
         : visible < 1  ? "rms/sigma 0.3 to 1"
         : visible < 3  ? "rms/sigma 1 to 3"
         : visible < 10 ? "rms/sigma 3 to 10"
                        : "rms/sigma beyond 10";
}

/// A setting in words; rows in bins.
std::string SettingOf(const RandomScore& score, const std::string& setting) {
  const auto found = score.settings.find(setting);
  if (found == score.settings.end()) return "-";
  if (setting != "rows") return found->second;
  const int rows = std::stoi(found->second);
  return rows <= 100   ? "60 to 100"
         : rows <= 200 ? "101 to 200"
         : rows <= 400 ? "201 to 400"
                       : "more than 400";
}

std::string CausesOf(const RandomScore& score) {
  return fmt::format("{} detectable",
                     std::count_if(score.causes.begin(),
                                   score.causes.end(),
                                   [](const CauseScore& cause) { return cause.detectable; }));
}

std::string TableLine(const std::string& name, const RandomScores& judged) {
  const auto n = static_cast<int>(judged.size());
  return fmt::format("  {:<30} {:<24} {:<24} {:<22} {}\n",
                     name,
                     RateText(Count(judged, [](const auto& s) { return s.listed; }), n),
                     RateText(Count(judged, [](const auto& s) { return s.alone; }), n),
                     RateText(Count(judged, [](const auto& s) { return s.wrong_single; }), n),
                     RateText(Count(judged, [](const auto& s) { return s.extra; }), n));
}

std::string Breakdown(const std::string& title,
                      const RandomScores& judged,
                      const std::function<std::string(const RandomScore&)>& value) {
  std::set<std::string> values;
  for (const RandomScore* const score : judged) values.insert(value(*score));
  std::string text = title + "\n";
  for (const std::string& one : values) {
    text += TableLine(one, Those(judged, [&](const auto& s) { return value(s) == one; }));
  }
  return text;
}

/// Of the detectable ones of each effect: how often it was itself listed, named.
std::string ByCause(const RandomScores& judged) {
  struct Counts {
    int all = 0, listed = 0, named = 0;
  };
  std::map<std::string, Counts> counts;
  for (const RandomScore* const score : judged) {
    for (const CauseScore& cause : score->causes) {
      if (!cause.detectable) continue;
      Counts& of = counts[cause.effect];
      ++of.all;
      of.listed += cause.listed ? 1 : 0;
      of.named += cause.named ? 1 : 0;
    }
  }
  std::string text = "cause (itself, detectable)\n";
  for (const auto& [effect, of] : counts) {
    text += fmt::format("  {:<30} {:<24} {:<24}\n",
                        effect,
                        RateText(of.listed, of.all),
                        RateText(of.named, of.all));
  }
  return text;
}

/// False alarms where nothing is left out, by the values of a setting.
std::string AlarmsBy(const RandomScores& null, const std::string& setting) {
  std::set<std::string> values;
  for (const RandomScore* const score : null) values.insert(SettingOf(*score, setting));
  std::string text;
  for (const std::string& value : values) {
    const RandomScores of =
        Those(null, [&](const auto& s) { return SettingOf(s, setting) == value; });
    const int alarms = Count(of, [](const auto& s) { return s.false_alarm; });
    text += fmt::format("  {:<44} {}\n",
                        fmt::format("false alarms, {} {}", setting, value),
                        RateText(alarms, static_cast<int>(of.size())));
  }
  return text;
}

double MedianKept(const RandomScores& judged) {
  std::vector<int> kept;
  for (const RandomScore* const score : judged) kept.push_back(score->kept);
  if (kept.empty()) return 0;
  std::sort(kept.begin(), kept.end());
  return kept[kept.size() / 2];
}

}  // namespace

std::string RandomTable(const std::vector<RandomScore>& scores) {
  if (scores.empty()) return "";
  const RandomScores judged = Those(Ended(scores), [](const auto& s) { return s.judged; });
  std::string text =
      fmt::format("random trials: {}; rates with Wilson intervals of 95 %\n", scores.size());
  for (const RandomRate& rate : RandomRates(scores)) {
    text += fmt::format("{:<46} {:<26} ({} {:g} %) {}\n",
                        rate.title,
                        RateText(rate.hits, rate.trials),
                        rate.at_most ? "at most" : "at least",
                        100 * rate.bar,
                        rate.reached() ? "" : "NOT REACHED");
  }
  const RandomScores null = Those(Ended(scores), [](const auto& s) { return s.null; });
  for (const char* const setting : {"sigma", "order"}) text += AlarmsBy(null, setting);
  text += fmt::format("hypotheses kept, median: {:g}\n\n", MedianKept(judged));
  text += fmt::format("  {:<30} {:<24} {:<24} {:<22} {}\n",
                      "cases with detectable causes",
                      "right or listed",
                      "right alone",
                      "wrong alone",
                      "extra");
  text += TableLine("all", judged);
  for (const char* const setting : {"estimate",
                                    "kind",
                                    "robot",
                                    "decimals",
                                    "repeats",
                                    "targets",
                                    "tail",
                                    "outliers",
                                    "sigma",
                                    "masses",
                                    "order",
                                    "rows",
                                    "test rows",
                                    "instrument",
                                    "setups"}) {
    text += Breakdown(
        setting, judged, [setting](const auto& score) { return SettingOf(score, setting); });
  }
  text += Breakdown("strength of the weakest detectable cause", judged, StrengthOf);
  text += Breakdown("causes", judged, CausesOf);
  return text + ByCause(judged);
}

}  // namespace dhcal
