#include "tools/proof/table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

namespace dhcal {
namespace {

using Condition = std::function<bool(const ProofScore&)>;

std::vector<const ProofScore*> Where(const std::vector<ProofScore>& scores, const Condition& in) {
  std::vector<const ProofScore*> some;
  for (const ProofScore& score : scores) {
    if (score.failure.empty() && in(score)) some.push_back(&score);
  }
  return some;
}

double Share(const std::vector<const ProofScore*>& some, const Condition& holds) {
  if (some.empty()) return ProofScore::kNone;
  const auto count =
      std::count_if(some.begin(), some.end(), [&](const ProofScore* s) { return holds(*s); });
  return static_cast<double>(count) / static_cast<double>(some.size());
}

double Median(std::vector<double> values) {
  if (values.empty()) return ProofScore::kNone;
  const std::size_t middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(middle), values.end());
  return values[middle];
}

std::vector<double> Ratios(const std::vector<ProofScore>& scores) {
  std::vector<double> ratios;
  for (const ProofScore& s : scores) {
    const double ratio = s.rms_after / s.rms_oracle;
    if (s.failure.empty() && std::isfinite(ratio)) ratios.push_back(ratio);
  }
  return ratios;
}

ProofFigure ShareAtMost(const std::string& name,
                        const std::string& title,
                        const std::vector<const ProofScore*>& some,
                        const Condition& holds,
                        double bar) {
  constexpr bool kPercent = true;
  return {name, title, Share(some, holds), bar, true, static_cast<int>(some.size()), kPercent};
}

ProofFigure ShareAtLeast(const std::string& name,
                         const std::string& title,
                         const std::vector<const ProofScore*>& some,
                         const Condition& holds,
                         double bar) {
  ProofFigure figure = ShareAtMost(name, title, some, holds, bar);
  figure.at_most = false;
  return figure;
}

std::string Percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.0f} %", 100 * share) : "-";
}

std::string Micrometres(double metres) {
  return std::isfinite(metres) ? fmt::format("{:.1f}", metres * 1e6) : "-";
}

/// Medians over the cases of a scenario.
std::string Line(const std::vector<ProofScore>& scores, const std::string& scenario) {
  const auto all = Where(scores, [&](const ProofScore& s) { return s.scenario == scenario; });
  if (all.empty()) return "";
  const auto median = [&](auto member) {
    std::vector<double> values;
    for (const ProofScore* const s : all) {
      if (std::isfinite(s->*member)) values.push_back(s->*member);
    }
    return Median(values);
  };
  std::vector<const ProofScore*> seen;
  std::copy_if(all.begin(), all.end(), std::back_inserter(seen), [](const ProofScore* s) {
    return s->detectable;
  });
  const bool null = all.front()->group == "null";
  const bool outside = !all.front()->library_has_all;
  int intervals = 0, covered = 0;
  for (const ProofScore* const s : all) {
    intervals += s->intervals;
    covered += s->covered;
  }
  return fmt::format(
      "{:<5} {:<46} {:>3} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>7} {:>7} {:>7} {:>5}\n",
      scenario,
      all.front()->story,
      all.size(),
      Percent(Share(all, [](const ProofScore& s) { return s.detected; })),
      null || outside ? "-" : Percent(Share(all, [](const ProofScore& s) { return s.truth_kept; })),
      null || outside ? "-" : Percent(Share(seen, [](const ProofScore& s) { return s.named; })),
      null      ? "-"
      : outside ? Percent(Share(seen, [](const ProofScore& s) { return s.unexplained_at_slot; }))
                : Percent(Share(seen, [](const ProofScore& s) { return s.place_right; })),
      Percent(Share(all, [](const ProofScore& s) { return s.wrong_single; })),
      intervals == 0 ? "-" : Percent(static_cast<double>(covered) / intervals),
      Micrometres(median(&ProofScore::rms_before)),
      Micrometres(median(&ProofScore::rms_after)),
      Micrometres(median(&ProofScore::rms_oracle)),
      fmt::format("{:.1f}", median(&ProofScore::seconds)));
}

}  // namespace

std::vector<ProofFigure> Figures(const std::vector<ProofScore>& scores) {
  const auto null = Where(scores, [](const ProofScore& s) { return s.group == "null"; });
  const auto truth =
      Where(scores, [](const ProofScore& s) { return s.group != "null" && s.library_has_all; });
  const auto outside = Where(scores, [](const ProofScore& s) { return !s.library_has_all; });
  const auto detectable =
      Where(scores, [](const ProofScore& s) { return s.detectable && s.library_has_all; });
  const auto concealed =
      Where(scores, [](const ProofScore& s) { return std::isfinite(s.largest_elsewhere); });
  const auto all = Where(scores, [](const ProofScore&) { return true; });
  std::vector<ProofFigure> figures = {ShareAtMost(
                                          "false_alarm",
                                          "false alarms where nothing is left out",
                                          null,
                                          [](const ProofScore& s) { return s.false_alarm; },
                                          0.02),
                                      ShareAtLeast(
                                          "truth_kept",
                                          "truth not excluded",
                                          truth,
                                          [](const ProofScore& s) { return s.truth_kept; },
                                          0.93),
                                      ShareAtMost(
                                          "wrong_single",
                                          "wrong single name, all cases",
                                          all,
                                          [](const ProofScore& s) { return s.wrong_single; },
                                          0.03),
                                      ShareAtMost(
                                          "wrong_single_outside",
                                          "wrong single name, physics outside the library",
                                          outside,
                                          [](const ProofScore& s) { return s.wrong_single; },
                                          0.10),
                                      ShareAtLeast(
                                          "named",
                                          "detectable causes named at class and joint",
                                          detectable,
                                          [](const ProofScore& s) { return s.named; },
                                          0.95),
                                      ShareAtLeast(
                                          "warned",
                                          "concealed: named, listed, or within the hidden risk",
                                          concealed,
                                          [](const ProofScore& s) { return s.warned; },
                                          0.95)};
  const std::vector<double> ratios = Ratios(scores);
  const auto count = static_cast<int>(ratios.size());
  figures.push_back({"rms_ratio_median",
                     "RMS of unseen rows after / the oracle's, median",
                     Median(ratios),
                     1.05,
                     true,
                     count,
                     false});
  const double worst =
      ratios.empty() ? ProofScore::kNone : *std::max_element(ratios.begin(), ratios.end());
  figures.push_back({"rms_ratio_worst",
                     "RMS of unseen rows after / the oracle's, worst",
                     worst,
                     1.5,
                     true,
                     count,
                     false});
  return figures;
}

std::string ProofTable(const std::vector<ProofScore>& scores) {
  std::string text = fmt::format(
      "{:<52} {:>3} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>23} {:>5}\n"
      "{:<52} {:>3} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>7} {:>7} {:>7} {:>5}\n",
      "scenario",
      "n",
      "found",
      "truth",
      "named",
      "place",
      "wrong",
      "inter-",
      "unseen rows, RMS [um]",
      "time",
      "",
      "",
      "",
      "kept",
      "",
      "right",
      "alone",
      "vals",
      "before",
      "after",
      "oracle",
      "[s]");
  std::vector<std::string> done;
  for (const ProofScore& score : scores) {
    if (std::find(done.begin(), done.end(), score.scenario) != done.end()) continue;
    done.push_back(score.scenario);
    text += Line(scores, score.scenario);
  }
  text += "\n";
  for (const ProofFigure& figure : Figures(scores)) {
    if (figure.cases == 0) continue;
    const auto number = [&](double value) {
      return figure.percent ? fmt::format("{:.1f} %", 100 * value) : fmt::format("{:.3f}", value);
    };
    text += fmt::format("{:<56} {:>8}   ({} {}; {} cases) {}\n",
                        figure.title,
                        number(figure.value),
                        figure.at_most ? "at most" : "at least",
                        number(figure.bar),
                        figure.cases,
                        figure.reached() ? "" : "NOT REACHED");
  }
  const auto failed = std::count_if(
      scores.begin(), scores.end(), [](const ProofScore& s) { return !s.failure.empty(); });
  if (failed > 0) text += fmt::format("{} cases failed; see their log files.\n", failed);
  return text;
}

nlohmann::ordered_json FiguresToJson(const std::vector<ProofFigure>& figures) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const ProofFigure& figure : figures) {
    array.push_back({{"name", figure.name},
                     {"title", figure.title},
                     {"value", figure.value},
                     {"bar", figure.bar},
                     {"bar_is", figure.at_most ? "at most" : "at least"},
                     {"cases", figure.cases},
                     {"reached", figure.reached()}});
  }
  return array;
}

}  // namespace dhcal
