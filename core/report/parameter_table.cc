// The estimated parameters with what is known about their errors.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/units.h"
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

}  // namespace

bool IsNoiseFree(const Result& result) {
  constexpr double kBelowAnyInstrument = 1e-7;  // [m]
  return result.best() != nullptr && result.best()->rms < kBelowAnyInstrument;
}

std::string ParameterSection(const Result& result) {
  const FitResult* const fit = result.best();
  if (fit == nullptr || fit->parameters.empty()) return "";
  const bool noise_free = IsNoiseFree(result);
  return Heading("PARAMETERS") +
         Wrap("  ",
              "Sigma and the 95 % interval are those of the correction. They hold for the "
              "parameters called identified; for the others see the next section.") +
         UnitTable(*fit, Unit::kRadian, noise_free) + UnitTable(*fit, Unit::kMetre, noise_free) +
         EffectTable(*fit) + FixedParameters(*fit);
}

}  // namespace dhcal
