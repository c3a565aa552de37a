// The two solvers compared: what they disagree on, and whether any reading could tell.
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

constexpr std::size_t kMostCompared = 10;

/// [SI] of the unit that corrections are printed in.
double PrintedUnit(Unit unit, bool noise_free) {
  if (unit == Unit::kOther) return 1;
  if (noise_free) return 1e-6;
  return unit == Unit::kRadian ? kMilliradian : kMillimetre;
}

const char* PrintedUnitName(Unit unit, bool noise_free) {
  if (unit == Unit::kOther) return "SI";
  if (noise_free) return unit == Unit::kRadian ? "urad" : "um";
  return unit == Unit::kRadian ? "mrad" : "mm";
}

/// NaN counts as no difference.
double Size(double difference) { return std::isnan(difference) ? 0.0 : std::abs(difference); }

double TotalSize(const ComparedParameter& parameter) {
  return Size(parameter.difference) + Size(parameter.in_null_space);
}

/// The largest of one kind of difference: "1.2e-09 mrad (theta5)".
std::string Largest(const std::vector<ComparedParameter>& comparison,
                    double ComparedParameter::*difference,
                    bool noise_free) {
  const ComparedParameter& largest =
      *std::max_element(comparison.begin(),
                        comparison.end(),
                        [&](const ComparedParameter& a, const ComparedParameter& b) {
                          return Size(a.*difference) < Size(b.*difference);
                        });
  if (Size(largest.*difference) == 0) return "none";
  return fmt::format("{:.1e} {} ({})",
                     Size(largest.*difference) / PrintedUnit(largest.unit, noise_free),
                     PrintedUnitName(largest.unit, noise_free),
                     largest.name);
}

Table DifferenceTable(std::vector<ComparedParameter> comparison, bool noise_free) {
  std::stable_sort(comparison.begin(),
                   comparison.end(),
                   [](const ComparedParameter& a, const ComparedParameter& b) {
                     return TotalSize(a) > TotalSize(b);
                   });
  Table table;
  table.columns = {{"parameter", "", 40, Table::Align::kLeft},
                   {"unit", "", 4, Table::Align::kLeft},
                   {"SVD Gauss-Newton", ""},
                   {"Levenberg-Marquardt", ""},
                   {"difference seen", ""},
                   {"inside null space", ""}};
  for (std::size_t i = 0; i < comparison.size() && i < kMostCompared; ++i) {
    const ComparedParameter& parameter = comparison[i];
    const double unit = PrintedUnit(parameter.unit, noise_free);
    table.AddRow({parameter.name,
                  PrintedUnitName(parameter.unit, noise_free),
                  FixedWithin(parameter.svd_gauss_newton / unit, 5, 12),
                  FixedWithin(parameter.levenberg_marquardt / unit, 5, 12),
                  Scientific(parameter.difference / unit, 1),
                  Scientific(parameter.in_null_space / unit, 1)});
  }
  if (comparison.size() > kMostCompared) table.AddLeftOut(comparison.size() - kMostCompared);
  return table;
}

}  // namespace

Section ComparisonSection(const Result& result) {
  if (result.comparison.empty() || result.best() == nullptr) return {};
  const bool noise_free = result.noise_free;
  const std::string sentence = fmt::format(
      "Largest difference of a correction that the readings can see: {}. Largest difference inside "
      "the null space, where both answers predict the same readings: {}. The parameters that "
      "differ most:",
      Largest(result.comparison, &ComparedParameter::difference, noise_free),
      Largest(result.comparison, &ComparedParameter::in_null_space, noise_free));
  return {"APPENDIX: THE TWO SOLVERS COMPARED",
          {Paragraph{{sentence}, ""}, DifferenceTable(result.comparison, noise_free)}};
}

}  // namespace dhcal
