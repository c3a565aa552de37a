// The answer, and whether it holds on rows that were not fitted.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/report/format.h"
#include "core/report/sections.h"
#include "core/report/text_table.h"

namespace dhcal {
namespace {

/// "0.02130 mm RMS (at most 0.06000 mm)": of the 3-D error where there is one.
std::string ErrorText(double rms, double rms_point, double max_point) {
  if (std::isnan(rms_point)) return WithMillimetres(rms) + " RMS";
  std::string text = WithMillimetres(rms_point) + " RMS";
  if (!std::isnan(max_point)) text += " (at most " + WithMillimetres(max_point) + ")";
  return text;
}

/// The fair figure before: with the nominal robot, but base and tool where they belong.
std::string ErrorBefore(const Result& result) {
  if (!result.base_and_tool_only) {
    return ErrorText(result.nominal.rms, result.nominal.rms_point, result.nominal.max_point) +
           " with the nominal parameters";
  }
  const Baseline& frames = *result.base_and_tool_only;
  return ErrorText(frames.rms, frames.rms_point, frames.max_point) +
         " with the nominal robot (base and tool fitted)";
}

std::string NominalError(const Result& result) {
  return ErrorText(result.nominal.rms, result.nominal.rms_point, result.nominal.max_point);
}

std::string Answer(const Result& result) {
  const FitResult& fit = *result.best();
  const ValidationResult& unseen = result.validation;
  const bool in_space = !std::isnan(fit.rms_point);
  std::string text = fmt::format("Error of the predicted {}{}: {}, {} after calibration.",
                                 result.kind.noun,
                                 in_space ? " (length of the 3-D error)" : "",
                                 ErrorBefore(result),
                                 ErrorText(fit.rms, fit.rms_point, fit.max_point));
  if (!std::isnan(unseen.rms_test)) {
    text += fmt::format(" On rows that were not fitted: {}.",
                        ErrorText(unseen.rms_test, unseen.rms_point_test, unseen.max_point_test));
  }
  return text;
}

void AddErrorRow(const std::string& what,
                 int rows,
                 double rms,
                 double rms_point,
                 double max_point,
                 TextTable* table) {
  const auto cell = [](double value) { return std::isnan(value) ? "-" : Millimetres(value); };
  table->AddRow(
      {what, rows < 0 ? "-" : std::to_string(rows), cell(rms), cell(rms_point), cell(max_point)});
}

std::string ErrorTable(const Result& result) {
  TextTable table({{"prediction", "", 40, TextTable::Align::kLeft},
                   {"rows", ""},
                   {"RMS, coordinate", "[mm]", 12, TextTable::Align::kPoint},
                   {"RMS, 3-D", "[mm]", 12, TextTable::Align::kPoint},
                   {"largest, 3-D", "[mm]", 12, TextTable::Align::kPoint}});
  const Baseline& nominal = result.nominal;
  AddErrorRow(
      "nominal parameters", result.rows, nominal.rms, nominal.rms_point, nominal.max_point, &table);
  if (result.base_and_tool_only) {
    const Baseline& frames = *result.base_and_tool_only;
    AddErrorRow("base and tool fitted, nominal robot",
                result.rows,
                frames.rms,
                frames.rms_point,
                frames.max_point,
                &table);
  }
  const FitResult& fit = *result.best();
  AddErrorRow(
      "calibrated, fitted rows", result.rows, fit.rms, fit.rms_point, fit.max_point, &table);
  const ValidationResult& unseen = result.validation;
  if (!std::isnan(unseen.rms_test)) {
    AddErrorRow("calibrated, unseen rows",
                unseen.rows,
                unseen.rms_test,
                unseen.rms_point_test,
                unseen.max_point_test,
                &table);
  }
  return table.ToString();
}

}  // namespace

std::string OutcomeSection(const Result& result) {
  const FitResult& fit = *result.best();
  std::string text = Heading("RESULT") + Wrap("  ", Answer(result)) + "\n" + ErrorTable(result);
  if (!std::isnan(fit.rms_rotation)) {
    text += "\n" + Wrap("  ",
                        fmt::format("Error of the predicted orientation: {:.4g} mrad RMS per "
                                    "component after calibration.",
                                    fit.rms_rotation / kMilliradian));
  }
  if (!std::isnan(fit.chi2_reduced)) {
    text += "\n" + Wrap("  ",
                        fmt::format("Reduced chi-square {:.3g}; 1 means that the residuals "
                                    "are as large as the stated noise.",
                                    fit.chi2_reduced));
  }
  return text;
}

std::string NoOutcomeSection(const Result& result) {
  std::string text = Heading("NO USABLE RESULT");
  text += Wrap("  ",
               "No solver found parameters that may be used, so none are printed and no "
               "calibrated.yaml is written. How each solver ended stands below.");
  if (!std::isnan(result.nominal.rms)) {
    text += "\n" + Wrap("  ",
                        fmt::format("Error of the predicted {} with the nominal parameters: "
                                    "{}.",
                                    result.kind.noun,
                                    NominalError(result)));
  }
  return text;
}

std::string ValidationSection(const Result& result) {
  if (result.best() == nullptr) return "";
  const ValidationResult& validation = result.validation;
  std::string text = Heading("VALIDATION");
  if (validation.method.empty()) {
    return text + Wrap("  ",
                       "Nothing was predicted that had not been fitted. To test the result, "
                       "give rows of the recording the value test in a column set.");
  }
  text += Wrap("  ",
               fmt::format("Method: {}, {} predicted without having been fitted.",
                           validation.method,
                           Counted(std::max(validation.rows, 0), "row")));
  text += Wrap("  ",
               fmt::format("RMS per coordinate: {} on fitted rows, {} on unseen rows; "
                           "noise: {}.",
                           WithMillimetres(validation.rms_train),
                           WithMillimetres(validation.rms_test),
                           WithMillimetres(validation.noise_sigma)));
  return text;
}

}  // namespace dhcal
