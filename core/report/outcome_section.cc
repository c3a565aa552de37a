// The answer, and whether it holds on rows that were not fitted.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/report/format.h"
#include "core/report/sections.h"

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

/// How the model of calibrated.yaml predicts rows that it has not seen.
const ValidationResult& Delivered(const Result& result) {
  return result.delivered ? result.delivered->validation : result.validation;
}

std::string Answer(const Result& result) {
  const FitResult& fit = *result.best();
  const ValidationResult& unseen = Delivered(result);
  const bool in_space = !std::isnan(fit.rms_point);
  std::string text = fmt::format("Error of the predicted {}{}: {}, {} after calibration.",
                                 result.kind.noun,
                                 in_space ? " (length of the 3-D error)" : "",
                                 ErrorBefore(result),
                                 ErrorText(fit.rms, fit.rms_point, fit.max_point));
  if (result.delivered) {
    const FitResult& all = result.delivered->fit;
    text.back() = ',';
    text += fmt::format(" {} with what was found (calibrated.yaml).",
                        ErrorText(all.rms, all.rms_point, all.max_point));
  }
  if (!std::isnan(unseen.rms_test)) {
    text += fmt::format(" On rows that were not fitted: {}.",
                        ErrorText(unseen.rms_test, unseen.rms_point_test, unseen.max_point_test));
  }
  return text;
}

/// A row of the table of errors.
std::vector<std::string> ErrorRow(const std::string& what, int rows, const Baseline& error) {
  const auto cell = [](double value) { return std::isnan(value) ? "-" : Millimetres(value); };
  return {what,
          rows < 0 ? "-" : std::to_string(rows),
          cell(error.rms),
          cell(error.rms_point),
          cell(error.max_point)};
}

Table ErrorTable(const Result& result) {
  Table table;
  table.columns = {{"prediction", "", 40, Table::Align::kLeft},
                   {"rows", ""},
                   {"RMS, coordinate", "mm", 12, Table::Align::kPoint},
                   {"RMS, 3-D", "mm", 12, Table::Align::kPoint},
                   {"largest, 3-D", "mm", 12, Table::Align::kPoint}};
  table.AddRow(ErrorRow("nominal parameters", result.rows, result.nominal));
  if (result.base_and_tool_only) {
    table.AddRow(
        ErrorRow("base and tool fitted, nominal robot", result.rows, *result.base_and_tool_only));
  }
  const auto add =
      [&](const std::string& what, const FitResult& fit, const ValidationResult& unseen) {
        table.AddRow(
            ErrorRow(what + ", fitted rows", result.rows, {fit.rms, fit.rms_point, fit.max_point}));
        if (std::isnan(unseen.rms_test)) return;
        table.AddRow(ErrorRow(what + ", unseen rows",
                              unseen.rows,
                              {unseen.rms_test, unseen.rms_point_test, unseen.max_point_test}));
      };
  if (!result.delivered) {
    add("calibrated", *result.best(), result.validation);
    return table;
  }
  const DeliveredModel& all = *result.delivered;
  add("geometry of the file", *result.best(), result.validation);
  add(all.rigid ? "with the effects found" : "with the geometry found", all.fit, all.validation);
  return table;
}

}  // namespace

Section OutcomeSection(const Result& result) {
  const FitResult& fit = *result.delivered_fit();
  Section section{"RESULT", {Paragraph{{Answer(result)}, ""}, ErrorTable(result)}};
  const auto say = [&](const std::string& sentence) {
    section.blocks.push_back(Paragraph{{sentence}, ""});
  };
  if (!std::isnan(fit.rms_rotation)) {
    say(
        fmt::format("Error of the predicted orientation: {:.4g} mrad RMS per component after "
                    "calibration.",
                    fit.rms_rotation / kMilliradian));
  }
  if (!std::isnan(fit.chi2_reduced)) {
    say(
        fmt::format("Reduced chi-square {:.3g}; 1 means that the residuals are as large as the "
                    "stated noise.",
                    fit.chi2_reduced));
  }
  return section;
}

Section NoOutcomeSection(const Result& result) {
  Section section{"NO USABLE RESULT",
                  {Paragraph{{"No solver found parameters that may be used, so none are printed "
                              "and no calibrated.yaml is written. How each solver ended stands "
                              "below."},
                             ""}}};
  if (!std::isnan(result.nominal.rms)) {
    section.blocks.push_back(
        Paragraph{{fmt::format("Error of the predicted {} with the nominal parameters: {}.",
                               result.kind.noun,
                               NominalError(result))},
                  ""});
  }
  return section;
}

Section ValidationSection(const Result& result) {
  if (result.best() == nullptr) return {};
  const ValidationResult& validation = Delivered(result);
  Paragraph text;
  if (validation.method.empty()) {
    text.lines = {
        "Nothing was predicted that had not been fitted. To test the result, give rows of the "
        "recording the value test in a column set."};
    return {"VALIDATION", {text}};
  }
  text.lines = {fmt::format("Method: {}, {} predicted without having been fitted.",
                            validation.method,
                            Counted(std::max(validation.rows, 0), "row")),
                fmt::format("RMS per coordinate: {} on fitted rows, {} on unseen rows; noise: {}.",
                            WithMillimetres(validation.rms_train),
                            WithMillimetres(validation.rms_test),
                            WithMillimetres(validation.noise_sigma))};
  return {"VALIDATION", {text}};
}

}  // namespace dhcal
