#include "core/report/error_table.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/physics/registry.h"
#include "core/report/format.h"

namespace dhcal {
namespace {

/// An error as it is told: in 3-D where there is one.
double Told(const MeasurementKind& kind, double rms, double rms_point) {
  return kind.is_point() && !std::isnan(rms_point) ? rms_point : rms;
}

std::string Cell(double value) { return std::isnan(value) ? "-" : Millimetres(value); }

/// The fair figure before: with the nominal robot, but base and tool where they belong.
const Baseline& Before(const Result& result) {
  return result.base_and_tool_only ? *result.base_and_tool_only : result.nominal;
}

const char* WordsBefore(const Result& result) {
  return result.base_and_tool_only ? "nominal robot, base and tool fitted" : "nominal parameters";
}

void AddRow(const std::string& what,
            const MeasurementKind& kind,
            const Baseline& fitted,
            const ValidationResult& unseen,
            Table* table) {
  table->AddRow({what,
                 Cell(Told(kind, fitted.rms, fitted.rms_point)),
                 Cell(fitted.max_point),
                 Cell(Told(kind, unseen.rms_test, unseen.rms_point_test)),
                 Cell(unseen.max_point_test)});
}

Baseline ErrorOf(const FitResult& fit) { return {fit.rms, fit.rms_point, fit.max_point}; }

/// What was found bends readings, and not the robot.
bool OnlyOfInstrument(const Result& result) {
  if (!result.diagnosis || result.diagnosis->model.empty()) return false;
  const std::vector<EffectRequest>& model = result.diagnosis->model;
  return std::all_of(model.begin(), model.end(), [](const EffectRequest& request) {
    const Effect* const effect = FindEffect(request.effect);
    return effect != nullptr && effect->Describe().of_instrument;
  });
}

}  // namespace

const ValidationResult& DeliveredValidation(const Result& result) {
  return result.delivered ? result.delivered->validation : result.validation;
}

double InSpace(const MeasurementKind& kind, double rms_coordinate) {
  return kind.is_point() ? std::sqrt(3.0) * rms_coordinate : rms_coordinate;
}

std::string ErrorName(const MeasurementKind& kind) { return kind.is_point() ? "RMS, 3-D" : "RMS"; }

double ErrorBefore(const Result& result) {
  const Baseline& before = Before(result);
  return Told(result.kind, before.rms, before.rms_point);
}

double ErrorAfter(const Result& result) {
  const FitResult& fit = *result.delivered_fit();
  return Told(result.kind, fit.rms, fit.rms_point);
}

double ErrorUnseen(const Result& result) {
  const ValidationResult& unseen = DeliveredValidation(result);
  return Told(result.kind, unseen.rms_test, unseen.rms_point_test);
}

std::string Headline(const Result& result) {
  const MeasurementKind& kind = result.kind;
  const FitResult& fit = *result.delivered_fit();
  const double unseen = ErrorUnseen(result);
  std::string text = fmt::format(
      "Error of the predicted {} ({}): {} with the {}, {} with calibrated.yaml",
      kind.noun,
      ErrorName(kind),
      WithMillimetres(ErrorBefore(result)),
      result.base_and_tool_only ? "nominal robot (base and tool fitted)" : WordsBefore(result),
      WithMillimetres(ErrorAfter(result)));
  if (!std::isnan(unseen)) {
    text += fmt::format(", {} on rows that were not fitted", WithMillimetres(unseen));
  }
  text += ".";
  // An estimated noise is of the model that was there when it was estimated.
  const bool known = !std::isnan(fit.chi2_reduced) && !std::isnan(result.noise_sigma);
  if (known && !result.noise_free) {
    text += fmt::format(" Noise of the readings: {} ({} per coordinate{}).",
                        WithMillimetres(InSpace(kind, result.noise_sigma)),
                        WithMillimetres(result.noise_sigma),
                        result.noise_source.empty() ? "" : ", " + result.noise_source);
  }
  return text;
}

Table ErrorTable(const Result& result) {
  const MeasurementKind& kind = result.kind;
  constexpr auto kPoint = Table::Align::kPoint;
  Table table;
  table.title = kind.is_point() ? "Errors in 3-D" : "Errors";
  table.columns = {{"prediction", "", 40, Table::Align::kLeft},
                   {"fitted rows, RMS", "mm", 16, kPoint},
                   {"largest", "mm", 12, kPoint},
                   {"unseen rows, RMS", "mm", 16, kPoint},
                   {"largest", "mm", 12, kPoint}};
  AddRow(WordsBefore(result), kind, Before(result), {}, &table);
  const Baseline rigid = ErrorOf(*result.best());
  if (!result.delivered) {
    AddRow("calibrated", kind, rigid, result.validation, &table);
    return table;
  }
  const DeliveredModel& all = *result.delivered;
  AddRow("geometry of the file, calibrated", kind, rigid, result.validation, &table);
  AddRow(
      all.rigid || OnlyOfInstrument(result) ? "with the effects found" : "with the geometry found",
      kind,
      ErrorOf(all.fit),
      all.validation,
      &table);
  return table;
}

}  // namespace dhcal
