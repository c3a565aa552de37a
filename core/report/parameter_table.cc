// The estimated parameters with what is known about their errors.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/units.h"
#include "core/math/statistics.h"
#include "core/report/format.h"
#include "core/report/sections.h"
#include "core/report/text_table.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostTableRows = 100;
constexpr std::size_t kMostFixedNames = 40;
constexpr int kNameWidth = 40;
constexpr int kNumberWidth = 9;
constexpr int kValueWidth = 10;
// A reduced chi-square this large is no noise that was stated a little too small, ...
constexpr double kFarAboveNoise = 1.5;
constexpr double kNoChance = 1e-3;  // ... and, with few readings, this improbable no chance.

/// The units that one table prints.
struct PrintedUnits {
  const char* title;
  const char* value_name;
  double value;  // [SI]
  const char* correction_name;
  double correction;  // [SI]
  int most_decimals;  // of a correction: what is finer is rounding
};

PrintedUnits UnitsOf(Unit unit, bool noise_free) {
  if (unit == Unit::kRadian) {
    return noise_free ? PrintedUnits{"Angles", "[deg]", kDegree, "[urad]", 1e-6, 3}
                      : PrintedUnits{"Angles", "[deg]", kDegree, "[mrad]", kMilliradian, 5};
  }
  return noise_free ? PrintedUnits{"Lengths", "[mm]", kMillimetre, "[um]", kMicrometre, 3}
                    : PrintedUnits{"Lengths", "[mm]", kMillimetre, "[mm]", kMillimetre, 5};
}

void AddParameter(const ParameterResult& parameter, const PrintedUnits& units, TextTable* table) {
  const double sigma = parameter.sigma / units.correction;
  // Two digits of the uncertainty, and all numbers beside it as many decimals.
  const int wanted = DecimalsOf(sigma, std::min(4, units.most_decimals));
  const int decimals = std::min(wanted, units.most_decimals);
  const int value_decimals = DecimalsOf(parameter.sigma / units.value, 6);
  const auto correction = [&](double number) {
    return FixedWithin(number / units.correction, decimals, kNumberWidth);
  };
  const auto value = [&](double number) {
    return FixedWithin(number / units.value, value_decimals, kValueWidth);
  };
  table->AddRow({parameter.name,
                 value(parameter.nominal),
                 correction(parameter.correction),
                 wanted > decimals ? Scientific(sigma, 1) : correction(parameter.sigma),
                 correction(parameter.ci95_low - parameter.nominal),
                 correction(parameter.ci95_high - parameter.nominal),
                 value(parameter.value),
                 ToString(parameter.verdict)});
}

std::string UnitTable(const FitResult& fit, Unit unit, bool noise_free) {
  const PrintedUnits units = UnitsOf(unit, noise_free);
  const char* const small = units.correction_name;
  constexpr auto point = TextTable::Align::kPoint;
  TextTable table({{"parameter", "", kNameWidth, TextTable::Align::kLeft},
                   {"nominal", units.value_name, kValueWidth, point},
                   {"correction", small, kNumberWidth, point},
                   {"+- sigma", small, kNumberWidth, point},
                   {"95 % from", small, kNumberWidth, point},
                   {"to", small, kNumberWidth, point},
                   {"calibrated", units.value_name, kValueWidth, point},
                   {"verdict", "", 12, TextTable::Align::kLeft}});
  std::size_t count = 0;
  for (const ParameterResult& parameter : fit.parameters) {
    if (parameter.unit != unit || parameter.verdict == Verdict::kFixed) continue;
    if (++count <= kMostTableRows) AddParameter(parameter, units, &table);
  }
  if (count == 0) return "";
  if (count > kMostTableRows) table.AddLine(AndMore(count - kMostTableRows));
  return fmt::format("\n  {}\n{}", units.title, table.ToString());
}

/// Parameters of physical effects, each in its own SI unit.
std::string EffectTable(const FitResult& fit) {
  TextTable table({{"parameter", "", kNameWidth, TextTable::Align::kLeft},
                   {"value", "", kNumberWidth + 1},
                   {"+- sigma", "", kNumberWidth + 1},
                   {"unit", "", 20, TextTable::Align::kLeft},
                   {"verdict", "", 12, TextTable::Align::kLeft}});
  bool any = false;
  for (const ParameterResult& parameter : fit.parameters) {
    if (parameter.unit != Unit::kOther) continue;
    any = true;
    table.AddRow({parameter.name,
                  Scientific(parameter.value, 3),
                  Scientific(parameter.sigma, 1),
                  parameter.unit_text,
                  ToString(parameter.verdict)});
  }
  return any ? "\n  Physical effects\n" + table.ToString() : "";
}

std::string FixedParameters(const FitResult& fit) {
  std::vector<std::string> names;
  for (const ParameterResult& parameter : fit.parameters) {
    if (parameter.verdict == Verdict::kFixed) names.push_back(parameter.name);
  }
  if (names.empty()) return "";
  const std::size_t total = names.size();
  if (total > kMostFixedNames) {
    names.resize(kMostFixedNames);
    names.push_back(AndMore(total - kMostFixedNames));
  }
  return "\n" + Wrap("  ", fmt::format("Held at their nominal values: {}", fmt::join(names, ", ")));
}

/// True where the diagnosis came to an answer: it gives up when the complete geometry has no fit.
bool IsDiagnosed(const Result& result) {
  return result.diagnosis && result.diagnosis->misfit.rows >= 0;
}

/// True if the readings are missed by more than their noise: by the diagnosis, else by chi-square.
bool LeavesMoreThanNoise(const Result& result, const FitResult& fit) {
  if (IsDiagnosed(result)) return result.diagnosis->verdict != DiagnosisVerdict::kConsistent;
  if (!(fit.chi2_reduced > kFarAboveNoise)) return false;
  const double squares = 2 * fit.cost;
  return ChiSquareTail(squares, squares / fit.chi2_reduced) < kNoChance;
}

/// True if all that was left out is geometry, which the readings took into other parameters.
bool OnlyGeometryLeftOut(const Result& result) {
  if (!IsDiagnosed(result) || result.diagnosis->verdict != DiagnosisVerdict::kExplained) {
    return false;
  }
  const std::vector<Finding>& findings = result.diagnosis->findings;
  return std::all_of(
      findings.begin(), findings.end(), [](const Finding& finding) { return finding.is_geometry; });
}

/// For which parameters the intervals hold. They know of noise and tolerances: what the model
/// leaves out moves parameters by any number of sigmas.
std::string IntervalWords(const Result& result, const FitResult& fit) {
  if (!LeavesMoreThanNoise(result, fit)) {
    return "Sigma and the 95 % interval are those of the correction. They hold for the "
           "parameters called identified; for the others see the next section.";
  }
  const bool with_effects = std::any_of(
      fit.parameters.begin(), fit.parameters.end(), [](const ParameterResult& parameter) {
        return parameter.unit == Unit::kOther;
      });
  const std::string why =
      OnlyGeometryLeftOut(result)
          ? "The geometry that the file estimates is not complete, so the intervals do not hold"
          : fmt::format("The {} model does not meet the noise, so the intervals do not hold",
                        with_effects ? "fitted" : "rigid");
  return fmt::format(
      "Sigma and the 95 % interval are those of the correction. {}, not even for the parameters "
      "called identified: what is left out has moved parameters{}.",
      why,
      IsDiagnosed(result) ? ", see LEFT-OUT PHYSICS" : "");
}

}  // namespace

bool IsNoiseFree(const Result& result) {
  constexpr double kBelowAnyInstrument = 1e-7;  // [m]
  return result.best() != nullptr && result.best()->rms < kBelowAnyInstrument;
}

std::string ParameterSection(const Result& result) {
  const FitResult* const fit = result.best();
  if (fit == nullptr || fit->parameters.empty()) return "";
  const bool noise_free = IsNoiseFree(result);
  return Heading("PARAMETERS") + Wrap("  ", IntervalWords(result, *fit)) +
         UnitTable(*fit, Unit::kRadian, noise_free) + UnitTable(*fit, Unit::kMetre, noise_free) +
         EffectTable(*fit) + FixedParameters(*fit);
}

}  // namespace dhcal
