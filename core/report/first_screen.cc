#include "core/report/first_screen.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/physics/effect.h"
#include "core/report/error_table.h"
#include "core/report/format.h"
#include "core/report/report.h"
#include "core/report/sections.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostFindings = 6;
constexpr std::size_t kMostAlternatives = 4;
constexpr std::size_t kMostExcluded = 6;
constexpr std::size_t kMostRemarks = 4;
constexpr std::size_t kMostReasons = 3;  // where there is no result, they hold the reason

std::string MoreInReport(std::size_t all, std::size_t shown) {
  return all > shown ? fmt::format("; {} more in report.txt", all - shown) : std::string();
}

/// The finding, and what could stand in its place.
std::string FindingText(const Finding& finding) {
  std::vector<std::string> others;
  for (const Confusable& other : finding.confusable_with) {
    if (others.size() == kMostAlternatives) break;
    others.push_back(InstanceName(other.effect));
  }
  std::string text = Capitalised(finding.sentence) + ".";
  if (others.empty()) return text;
  return text + fmt::format(" Or instead: {}{}.",
                            fmt::join(others, ", "),
                            MoreInReport(finding.confusable_with.size(), others.size()));
}

Section FindingsSection(const Result& result) {
  if (!result.diagnosis) return {};
  const DiagnosisResult& d = *result.diagnosis;
  Section section{DiagnosisTitle(d), {}};
  if (d.findings.empty()) {
    section.blocks.push_back(Paragraph{{Capitalised(d.summary) + "."}, ""});
  } else if (d.verdict == DiagnosisVerdict::kAmbiguous) {
    section.blocks.push_back(Paragraph{
        {"More than one effect explains the misfit at these poses; the likeliest first."}, ""});
  }
  List list;
  for (const Finding& finding : d.findings) {
    if (list.items.size() == kMostFindings) break;
    list.items.push_back({FindingText(finding), fmt::format("{}.", list.items.size() + 1), {}});
  }
  if (d.findings.size() > kMostFindings) {
    list.items.push_back(
        {fmt::format("... and {} more in report.txt", d.findings.size() - kMostFindings), "", {}});
  }
  if (!list.items.empty()) section.blocks.push_back(list);
  if (d.unexplained && !d.findings.empty()) {
    section.blocks.push_back(Paragraph{{"What they leave exceeds the noise of the readings."}, ""});
  }
  return section;
}

/// "17 (10.00 mm off), 43"; what is odd about them is in the report.
std::string SetAsideText(const Result& result) {
  std::vector<std::string> rows;
  for (const RowSetAside& row : result.rows_set_aside) {
    if (rows.size() == kMostExcluded) break;
    rows.push_back(std::isnan(row.size)
                       ? fmt::format("{}", row.row_idx + 1)
                       : fmt::format("{} ({} off)", row.row_idx + 1, WithMillimetres(row.size)));
  }
  return fmt::format(
      "{}{}", fmt::join(rows, ", "), MoreInReport(result.rows_set_aside.size(), rows.size()));
}

/// What would settle an open verdict.
std::vector<std::string> StepsToSettle(const DiagnosisResult& d) {
  std::vector<std::string> steps;
  if (d.verdict == DiagnosisVerdict::kAmbiguous) {
    for (const Finding& finding : d.findings) {
      if (finding.confusable_with.empty() || finding.separating_advice.empty()) continue;
      steps.push_back(fmt::format("Measure, {}.", finding.separating_advice));
      break;
    }
  }
  if (d.unexplained && d.unexplained->slot.empty()) {
    steps.emplace_back(
        "Read a few poses several times: that tells whether the readings are noisier than stated.");
  } else if (d.unexplained) {
    steps.push_back(
        fmt::format("Look at {}: what is not explained is largest there and depends on {}.",
                    d.unexplained->slot,
                    d.unexplained->driver));
  }
  return steps;
}

std::vector<std::string> NextSteps(const Result& result) {
  std::vector<std::string> steps;
  if (!result.rows_set_aside.empty()) {
    steps.emplace_back("Check how the excluded rows were taken.");
  }
  if (result.diagnosis) {
    for (std::string& step : StepsToSettle(*result.diagnosis)) steps.push_back(std::move(step));
  }
  if (DeliveredValidation(result).method.empty()) {
    steps.emplace_back(
        "Nothing was tested on rows that were not fitted: write test in a column set of some "
        "rows.");
  }
  if (!result.kind.turns_show()) {
    steps.emplace_back(
        "The readings do not show how the tool is turned: its orientation is not calibrated.");
  }
  if (result.delivered && result.delivered->rigid) {
    steps.emplace_back(
        "Use calibrated.yaml where effects can be compensated; where only Denavit-Hartenberg rows "
        "can be entered, calibrated_rigid.yaml.");
  } else {
    steps.emplace_back("Use the Denavit-Hartenberg rows, base and tool of calibrated.yaml.");
  }
  return steps;
}

/// As a row of a list of terms; the further ones stand below the first.
void AddTerm(const std::string& label, const std::vector<std::string>& lines, List* list) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    list->items.push_back({lines[k], k == 0 ? label : std::string(), {}});
  }
}

std::vector<std::string> FirstOf(const std::vector<std::string>& lines, std::size_t most) {
  std::vector<std::string> first(lines.begin(),
                                 lines.begin() + static_cast<long>(std::min(lines.size(), most)));
  if (lines.size() > first.size()) {
    first.push_back(fmt::format("... and {} more in report.txt", lines.size() - first.size()));
  }
  return first;
}

std::string FilesText(const Result& result, const std::string& folder) {
  std::vector<std::string> names;
  if (result.best() != nullptr) names.emplace_back("calibrated.yaml");
  if (result.delivered && result.delivered->rigid) names.emplace_back("calibrated_rigid.yaml");
  if (!result.residuals.empty()) names.emplace_back("residuals.csv");
  names.emplace_back("result.json");
  return fmt::format("{}/: {}, and report.html (as text report.txt) with all details",
                     folder,
                     fmt::join(names, ", "));
}

Section EndSection(const Result& result, const std::string& folder) {
  List terms;
  terms.kind = List::Kind::kTerms;
  const bool usable = result.best() != nullptr;
  if (!result.rows_set_aside.empty()) AddTerm("Excluded rows", {SetAsideText(result)}, &terms);
  if (usable) {
    AddTerm("Input", FirstOf(result.setup.remarks, kMostRemarks), &terms);
    AddTerm("Next", NextSteps(result), &terms);
  }
  if (!folder.empty()) AddTerm("Files", {FilesText(result, folder)}, &terms);
  if (terms.items.empty()) return {};
  return {"", {terms}};
}

}  // namespace

Document FirstScreenOf(const Result& result, const std::string& folder) {
  Document document = EmptyReport(result);
  const auto add = [&](Section section) {
    if (!section.empty()) document.sections.push_back(std::move(section));
  };
  if (!result.setup.plausible) {
    add(SetupSection(result));
  } else if (result.best() == nullptr) {
    add(SetupSection(result));
    Section none = NoOutcomeSection(result);
    for (const FitResult& fit : result.fits) {
      none.blocks.push_back(Paragraph{{fit.message}, SolverName(fit.solver) + ":"});
    }
    for (const std::string& note : FirstOf(result.notes, kMostReasons)) {
      none.blocks.push_back(Paragraph{{note}, ""});
    }
    add(std::move(none));
  } else {
    if (result.setup.cured) add(SetupSection(result));
    add({"", {Paragraph{{Headline(result)}, ""}, ErrorTable(result)}});
    const std::string task = TaskSentence(result);
    if (!task.empty()) add({"", {Paragraph{{task}, ""}}});
    add(FindingsSection(result));
  }
  add(EndSection(result, folder));
  return document;
}

}  // namespace dhcal
