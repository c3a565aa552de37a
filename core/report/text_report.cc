#include "core/report/text_report.h"

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/report/format.h"
#include "core/report/sections.h"

namespace dhcal {
namespace {

std::string Title(const Result& result) {
  const std::string version = Clip(result.program_version, 20);
  const std::string program = "ceres_dhcal" + (version.empty() ? "" : " " + version);
  const int left = kReportWidth - CountCharacters(program) - 2;
  const std::string title = Clip("Kinematic calibration: " + result.problem, left);
  const int gap = kReportWidth - CountCharacters(title) - CountCharacters(program);
  return fmt::format("{}{}{}\n{}\n\n",
                     title,
                     std::string(static_cast<std::size_t>(gap), ' '),
                     program,
                     std::string(kReportWidth, '='));
}

}  // namespace

std::string TextReport(const ProblemSpec& spec, const Result& result) {
  const std::string head = Title(result) + InputSection(spec, result);
  if (result.best() == nullptr) {
    return head + NoOutcomeSection(result) + DiagnosisSection(spec, result) +
           SolverSection(result) + NotesSection(result);
  }
  return head + OutcomeSection(result) + DiagnosisSection(spec, result) + SolverSection(result) +
         ParameterSection(result) + IdentifiabilitySection(result) + ComparisonSection(result) +
         ValidationSection(result) + ResidualSection(result) + NotesSection(result);
}

}  // namespace dhcal
