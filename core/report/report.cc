#include "core/report/report.h"

#include <string>
#include <utility>
#include <vector>

#include "core/report/answer.h"
#include "core/report/figures/figures.h"
#include "core/report/html/html_renderer.h"
#include "core/report/sections.h"
#include "core/report/text_renderer.h"

namespace dhcal {
namespace {

std::string TextReport(const Document& document) { return ToText(document); }
std::string HtmlReport(const Document& document) { return ToHtml(document); }

/// The section with figures behind it, those that show something; `title` where it had nothing to
/// say itself.
Section With(Section section, const std::vector<Figure>& figures, const char* title = "") {
  if (section.empty()) section.title = title;
  for (const Figure& figure : figures) {
    if (!figure.empty()) section.blocks.emplace_back(figure);
  }
  return section;
}

Section DiagnosisWithFigures(const ProblemSpec& spec, const Result& result) {
  Section section = DiagnosisSection(spec, result);
  if (!result.diagnosis) return section;
  return With(std::move(section),
              {JointErrorFigure(spec, result),
               OrderFigure(spec, result),
               EvidenceFigure(*result.diagnosis),
               HiddenFigure(*result.diagnosis)});
}

Section MapWithFigure(const Result& result) {
  Section section = MapSection(result);
  return section.empty() ? section : With(std::move(section), {MapFigure(*result.diagnosis)});
}

std::vector<Section> Sections(const ProblemSpec& spec,
                              const Recording& recording,
                              const Result& result) {
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
  return {With(InputSection(spec, result), {RangeFigure(spec, recording)}),
          SetupSection(result),
          SetAsideSection(result),
          With(OutcomeSection(result), {ErrorFigure(result), ArrowFigure(spec, recording, result)}),
          TaskSection(result),
          DiagnosisWithFigures(spec, result),
          With(ParameterSection(result), {CorrectionFigure(result)}),
          IdentifiabilitySection(result),
          ValidationSection(result),
          With(ResidualSection(result),
               {RowFigure(result), DriverFigure(spec, recording, result)},
               "RESIDUALS"),
          NotesSection(result),
          SolverSection(result),
          ComparisonSection(result),
          QualitySection(result),
          MapWithFigure(result)};
}

}  // namespace

Document EmptyReport(const Result& result) {
  Document document;
  document.title = "Kinematic calibration: " + result.problem;
  document.program = "ceres_dhcal";
  if (!result.program_version.empty()) document.program += " " + result.program_version;
  return document;
}

Document ReportOf(const ProblemSpec& spec, const Recording& recording, const Result& result) {
  Document document = EmptyReport(result);
  document.answer = AnswerOf(result);
  for (Section& section : Sections(spec, recording, result)) {
    if (!section.empty()) document.sections.push_back(std::move(section));
  }
  return document;
}

const std::vector<ReportFormat>& ReportFormats() {
  static const std::vector<ReportFormat> formats = {{"report.txt", TextReport},
                                                    {"report.html", HtmlReport}};
  return formats;
}

}  // namespace dhcal
