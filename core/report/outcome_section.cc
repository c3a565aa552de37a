// The answer, and whether it holds on rows that were not fitted.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/report/error_table.h"
#include "core/report/format.h"
#include "core/report/sections.h"

namespace dhcal {

Section OutcomeSection(const Result& result) {
  const FitResult& fit = *result.delivered_fit();
  Section section{"RESULT", {Paragraph{{Headline(result)}, ""}, ErrorTable(result)}};
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
  const Baseline& nominal = result.nominal;
  if (!std::isnan(nominal.rms)) {
    section.blocks.push_back(
        Paragraph{{fmt::format("Error of the predicted {} with the nominal parameters: {} ({}).",
                               result.kind.noun,
                               WithMillimetres(InSpace(result.kind, nominal.rms)),
                               ErrorName(result.kind))},
                  ""});
  }
  return section;
}

Section ValidationSection(const Result& result) {
  if (result.best() == nullptr) return {};
  const ValidationResult& validation = DeliveredValidation(result);
  Paragraph text;
  if (validation.method.empty()) {
    text.lines = {
        "Nothing was predicted that had not been fitted. To test the result, give rows of the "
        "recording the value test in a column set."};
    return {"VALIDATION", {text}};
  }
  const auto shown = [&](double rms) { return WithMillimetres(InSpace(result.kind, rms)); };
  text.lines = {fmt::format("Method: {}, {} predicted without having been fitted.",
                            validation.method,
                            Counted(std::max(validation.rows, 0), "row")),
                fmt::format("{}: {} on fitted rows, {} on unseen rows; noise: {}.",
                            ErrorName(result.kind),
                            shown(validation.rms_train),
                            shown(validation.rms_test),
                            shown(validation.noise_sigma))};
  return {"VALIDATION", {text}};
}

}  // namespace dhcal
