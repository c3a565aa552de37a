#include "tools/compare/comparison_report.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/report/format.h"
#include "tools/compare/moved.h"

namespace dhcal {
namespace {

constexpr double kFar = 3;               // sigmas: hardly ever by chance
constexpr double kShareBeyond = 0.0027;  // of normal numbers
constexpr std::size_t kMostRows = 60;
constexpr int kNameColumnWidth = 36;

std::string CellOf(double metres) { return std::isnan(metres) ? "-" : Millimetres(metres); }

std::string VerdictSentence(const ReadResult& a, const ReadResult& b) {
  const std::string figures = fmt::format("A {}, B {} (RMS{})",
                                          WithMillimetres(a.unseen),
                                          WithMillimetres(b.unseen),
                                          a.in_space && b.in_space ? ", 3-D" : "");
  switch (BetterOnUnseenRows(a, b)) {
    case Better::kA:
      return "A predicts rows better that were not fitted: " + figures + ".";
    case Better::kB:
      return "B predicts rows better that were not fitted: " + figures + ".";
    case Better::kAlike:
      return "On rows that were not fitted neither is better beyond chance: " + figures + ".";
    case Better::kNotKnown:
      break;
  }
  return "Which is better cannot be told: each has to be tested on rows that were not fitted, of "
         "one kind of readings.";
}

Table ErrorsOf(const ReadResult& a, const ReadResult& b) {
  Table table;
  constexpr auto kPoint = Table::Align::kPoint;
  table.title = a.in_space && b.in_space ? "Errors in 3-D" : "Errors";
  table.columns = {{"", "", kNameColumnWidth, Table::Align::kLeft},
                   {"A", "mm", 12, kPoint},
                   {"B", "mm", 12, kPoint}};
  const auto add = [&](const char* what, double of_a, double of_b) {
    table.AddRow({what, CellOf(of_a), CellOf(of_b)});
  };
  add("before calibration, RMS", a.before, b.before);
  add("calibrated.yaml on fitted rows, RMS", a.fitted, b.fitted);
  add("... largest", a.fitted_max, b.fitted_max);
  add("... on rows not fitted, RMS", a.unseen, b.unseen);
  add("... largest", a.unseen_max, b.unseen_max);
  add("noise of the readings", a.noise, b.noise);
  return table;
}

std::string Unseen(const ReadResult& result) {
  if (result.unseen_method.empty()) return "none";
  return fmt::format("{}, {}", Counted(result.unseen_rows, "row"), result.unseen_method);
}

Table Inputs(const ReadResult& a, const ReadResult& b) {
  Table table;
  table.columns = {{"", "", kNameColumnWidth, Table::Align::kLeft},
                   {"A", "", 30, Table::Align::kLeft},
                   {"B", "", 30, Table::Align::kLeft}};
  table.AddRow({"folder", a.folder, b.folder});
  table.AddRow({"problem", a.problem, b.problem});
  table.AddRow({"kind of readings", a.kind, b.kind});
  table.AddRow({"rows fitted", std::to_string(a.rows), std::to_string(b.rows)});
  table.AddRow({"rows not fitted", Unseen(a), Unseen(b)});
  const auto verdict = [](const ReadResult& of) {
    return of.diagnosis.empty() ? std::string("not run") : of.diagnosis;
  };
  table.AddRow({"diagnosis", verdict(a), verdict(b)});
  return table;
}

/// In which unit a parameter is told: with m or u before the SI unit, as its size asks.
std::pair<double, std::string> UnitFor(const PairedParameter& parameter) {
  if (parameter.unit == "m") return {kMillimetre, "mm"};
  if (parameter.unit == "rad") return {kMilliradian, "mrad"};
  const double size = std::max(std::abs(parameter.a), std::abs(parameter.b));
  if (size >= 0.1) return {1, parameter.unit};
  return size >= 1e-4 ? std::pair(1e-3, "m" + parameter.unit)
                      : std::pair(1e-6, "u" + parameter.unit);
}

Table MovedTable(const Moved& moved) {
  Table table;
  constexpr auto kPoint = Table::Align::kPoint;
  table.title = "Parameters that both determine, the farthest in sigmas first";
  table.columns = {{"parameter", "", kNameColumnWidth, Table::Align::kLeft},
                   {"A", "", 12, kPoint},
                   {"B", "", 12, kPoint},
                   {"B - A", "", 11, kPoint},
                   {"+- sigma", "", 10, kPoint},
                   {"unit", "", 12, Table::Align::kLeft},
                   {"sigmas", "", 8, kPoint}};
  for (const PairedParameter& entry : moved.determined) {
    if (table.rows.size() == kMostRows) {
      table.AddLeftOut(moved.determined.size() - kMostRows);
      break;
    }
    const auto [scale, unit] = UnitFor(entry);
    const int decimals = std::min(DecimalsOf(entry.sigma / scale, 4), 6);
    const auto cell = [&, scale = scale](double value) { return Fixed(value / scale, decimals); };
    table.AddRow({entry.name,
                  cell(entry.a),
                  cell(entry.b),
                  cell(entry.b - entry.a),
                  cell(entry.sigma),
                  unit,
                  Fixed(entry.sigmas(), 1)});
  }
  return table;
}

std::string MovedSentence(const Moved& moved) {
  const std::size_t all = moved.determined.size();
  const auto far = static_cast<std::size_t>(
      std::count_if(moved.determined.begin(), moved.determined.end(), [](const auto& entry) {
        return std::abs(entry.sigmas()) > kFar;
      }));
  return fmt::format(
      "{} of {} parameters that both determine {} by more than {:.0f} sigmas; by "
      "chance {:.1f} would.",
      far,
      all,
      far == 1 ? "differs" : "differ",
      kFar,
      kShareBeyond * static_cast<double>(all));
}

void AddNames(const char* label, const std::vector<std::string>& names, Section* section) {
  if (names.empty()) return;
  section->blocks.push_back(Paragraph{{fmt::format("{}.", fmt::join(names, ", "))}, label});
}

Section EffectsSection(const ReadResult& a, const ReadResult& b) {
  std::vector<std::string> both, only_a, only_b;
  const auto has = [](const ReadResult& in, const std::string& name) {
    return std::find(in.effects.begin(), in.effects.end(), name) != in.effects.end();
  };
  for (const std::string& name : a.effects) (has(b, name) ? both : only_a).push_back(name);
  for (const std::string& name : b.effects) {
    if (!has(a, name)) only_b.push_back(name);
  }
  Section section{"EFFECTS BEYOND THE RIGID GEOMETRY", {}};
  AddNames("In both:", both, &section);
  AddNames("In A only:", only_a, &section);
  AddNames("In B only:", only_b, &section);
  return section;
}

Section MovedSection(const ReadResult& a, const ReadResult& b, const Moved& moved) {
  Section section{"WHAT MOVED", {}};
  section.blocks.push_back(Paragraph{{MovedSentence(moved)}, ""});
  if (!moved.determined.empty()) section.blocks.push_back(MovedTable(moved));
  AddNames("Not compared:", moved.open, &section);
  if (!moved.open.empty()) {
    section.blocks.push_back(
        Paragraph{{"One or both recordings do not determine these by themselves; they are right "
                   "only in company with others."},
                  ""});
  }
  AddNames("Estimated in A only:", moved.only_a, &section);
  AddNames("Estimated in B only:", moved.only_b, &section);
  std::vector<std::string> cautions = {
      "The sigmas take the recordings as independent: of one recording fitted twice the "
      "differences are smaller than they say."};
  if (!a.intervals_hold || !b.intervals_hold) {
    cautions.emplace_back(
        "The intervals of one or both do not hold (its report says why): the true sigmas are "
        "larger.");
  }
  section.blocks.push_back(Paragraph{cautions, "Caution:"});
  return section;
}

}  // namespace

Document ComparisonReport(const ReadResult& a, const ReadResult& b) {
  const Moved moved = MovedBetween(a, b);
  Document document;
  document.title = fmt::format("Comparison of two calibrations: {} and {}", a.problem, b.problem);
  document.program = std::string("dhcal_compare ") + DHCAL_VERSION;
  Section better{"WHICH IS BETTER", {}};
  better.blocks.push_back(Paragraph{{VerdictSentence(a, b)}, ""});
  better.blocks.push_back(ErrorsOf(a, b));
  document.answer = {better, Section{"", {Paragraph{{MovedSentence(moved)}, ""}}}};
  better.blocks.push_back(Inputs(a, b));
  document.sections = {better, EffectsSection(a, b), MovedSection(a, b, moved)};
  return document;
}

}  // namespace dhcal
