#include "core/report/report.h"

#include <string>
#include <utility>
#include <vector>

#include "core/report/sections.h"
#include "core/report/text_renderer.h"

namespace dhcal {
namespace {

std::string TextReport(const Document& document) { return ToText(document); }

std::vector<Section> Sections(const ProblemSpec& spec, const Result& result) {
  if (!result.setup.plausible) {
    return {InputSection(spec, result), SetupSection(result), SolverSection(result)};
  }
  if (result.best() == nullptr) {
    return {InputSection(spec, result),
            SetupSection(result),
            NoOutcomeSection(result),
            DiagnosisSection(spec, result),
            SolverSection(result),
            NotesSection(result)};
  }
  return {InputSection(spec, result),
          SetupSection(result),
          SetAsideSection(result),
          OutcomeSection(result),
          DiagnosisSection(spec, result),
          ParameterSection(result),
          IdentifiabilitySection(result),
          ValidationSection(result),
          ResidualSection(result),
          NotesSection(result),
          SolverSection(result),
          ComparisonSection(result),
          QualitySection(result),
          MapSection(result)};
}

}  // namespace

Document EmptyReport(const Result& result) {
  Document document;
  document.title = "Kinematic calibration: " + result.problem;
  document.program = "ceres_dhcal";
  if (!result.program_version.empty()) document.program += " " + result.program_version;
  return document;
}

Document ReportOf(const ProblemSpec& spec, const Result& result) {
  Document document = EmptyReport(result);
  for (Section& section : Sections(spec, result)) {
    if (!section.empty()) document.sections.push_back(std::move(section));
  }
  return document;
}

const std::vector<ReportFormat>& ReportFormats() {
  static const std::vector<ReportFormat> formats = {{"report.txt", TextReport}};
  return formats;
}

}  // namespace dhcal
