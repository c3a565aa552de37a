// The estimated parameters with what is known about their errors.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/report/format.h"
#include "core/report/sections.h"

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
    return noise_free ? PrintedUnits{"Angles", "deg", kDegree, "urad", 1e-6, 3}
                      : PrintedUnits{"Angles", "deg", kDegree, "mrad", kMilliradian, 5};
  }
  return noise_free ? PrintedUnits{"Lengths", "mm", kMillimetre, "um", kMicrometre, 3}
                    : PrintedUnits{"Lengths", "mm", kMillimetre, "mm", kMillimetre, 5};
}

std::vector<std::string> ParameterRow(const ParameterResult& parameter, const PrintedUnits& units) {
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
  return {parameter.name,
          value(parameter.nominal),
          correction(parameter.correction),
          wanted > decimals ? Scientific(sigma, 1) : correction(parameter.sigma),
          correction(parameter.ci95_low - parameter.nominal),
          correction(parameter.ci95_high - parameter.nominal),
          value(parameter.value),
          ToString(parameter.verdict)};
}

/// Where the instrument and the tool stand, which says nothing of the robot.
bool IsOfFrames(const ParameterResult& parameter) {
  return StartsWith(parameter.name, "base_") || StartsWith(parameter.name, "tool_");
}

/// The parameters of one unit, of the robot or of base and tool; without rows where there are none.
Table UnitTable(const FitResult& fit, Unit unit, bool of_frames, bool noise_free) {
  const PrintedUnits units = UnitsOf(unit, noise_free);
  const char* const small = units.correction_name;
  constexpr auto point = Table::Align::kPoint;
  Table table;
  table.title = fmt::format("{} of {}", units.title, of_frames ? "base and tool" : "the robot");
  table.columns = {{"parameter", "", kNameWidth, Table::Align::kLeft},
                   {"nominal", units.value_name, kValueWidth, point},
                   {"correction", small, kNumberWidth, point},
                   {"+- sigma", small, kNumberWidth, point},
                   {"95 % from", small, kNumberWidth, point},
                   {"to", small, kNumberWidth, point},
                   {"calibrated", units.value_name, kValueWidth, point},
                   {"verdict", "", 12, Table::Align::kLeft}};
  std::size_t count = 0;
  for (const ParameterResult& parameter : fit.parameters) {
    if (parameter.unit != unit || parameter.verdict == Verdict::kFixed) continue;
    if (IsOfFrames(parameter) != of_frames) continue;
    if (++count <= kMostTableRows) table.AddRow(ParameterRow(parameter, units));
  }
  if (count > kMostTableRows) table.AddLeftOut(count - kMostTableRows);
  return table;
}

/// Parameters of physical effects, each in its own SI unit.
Table EffectTable(const FitResult& fit) {
  Table table;
  table.title = "Physical effects";
  table.columns = {{"parameter", "", kNameWidth, Table::Align::kLeft},
                   {"value", "", kNumberWidth + 1},
                   {"+- sigma", "", kNumberWidth + 1},
                   {"unit", "", 20, Table::Align::kLeft},
                   {"verdict", "", 12, Table::Align::kLeft}};
  std::map<std::string, int> values_of_curve;
  for (const ParameterResult& parameter : fit.parameters) {
    if (parameter.unit != Unit::kOther) continue;
    const std::string curve = CurveOf(parameter.name);
    if (!curve.empty()) {
      ++values_of_curve[curve];
      continue;
    }
    table.AddRow({parameter.name,
                  Scientific(parameter.value, 3),
                  Scientific(parameter.sigma, 1),
                  parameter.unit_text,
                  ToString(parameter.verdict)});
  }
  for (const auto& [curve, count] : values_of_curve) {
    table.AddRow({curve, "-", "-", fmt::format("curve of {} values", count), "-"});
  }
  return table;
}

/// Which parameters were held; "" when none was.
std::string HeldWords(const FitResult& fit) {
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
  return fmt::format("Not estimated: {}", fmt::join(names, ", "));
}

/// For which parameters the intervals hold.
std::string IntervalWords(const Result& result, const FitResult& fit) {
  const IntervalVerdict intervals =
      result.delivered ? result.delivered->intervals : result.intervals;
  if (intervals == IntervalVerdict::kHold) {
    return "Sigma and the 95 % interval are those of the correction. They hold for the parameters "
           "called identified; for the others see the next section.";
  }
  const bool with_effects = std::any_of(
      fit.parameters.begin(), fit.parameters.end(), [](const ParameterResult& parameter) {
        return parameter.unit == Unit::kOther;
      });
  const std::string why =
      intervals == IntervalVerdict::kGeometryIncomplete
          ? "The geometry that the file estimates is not complete, so the intervals do not hold"
          : fmt::format("The {} model does not meet the noise, so the intervals do not hold",
                        with_effects ? "fitted" : "rigid");
  const bool diagnosed = result.diagnosis && result.diagnosis->answered();
  return fmt::format(
      "Sigma and the 95 % interval are those of the correction. {}, not even for the parameters "
      "called identified: what is left out has moved parameters{}.",
      why,
      diagnosed ? ", see UNMODELLED EFFECTS" : "");
}

/// Whose parameters these are.
std::string DeliveredWords(const DeliveredModel& model) {
  if (!model.rigid) {
    return "The file's geometry and what was found missing in it, fitted together: what "
           "calibrated.yaml holds.";
  }
  return "Geometry and effects found, fitted together: what calibrated.yaml holds, for controllers "
         "that take effects, too. The robot without them, for controllers that take "
         "Denavit-Hartenberg rows only, is in calibrated_rigid.yaml.";
}

}  // namespace

std::string CurveOf(const std::string& parameter) {
  // "tool_z.at_home" is no such value: its run is not a number.
  const std::size_t at = parameter.find(".at_");
  const std::size_t number = at + 4;
  if (at == std::string::npos || number >= parameter.size()) return "";
  const bool is_number = parameter.find_first_not_of("-.0123456789", number) == std::string::npos;
  return is_number ? parameter.substr(0, at) : "";
}

Section ParameterSection(const Result& result) {
  const FitResult* const fit = result.delivered_fit();
  if (fit == nullptr || fit->parameters.empty()) return {};
  Section section{"PARAMETERS", {}};
  if (result.delivered) {
    section.blocks.push_back(Paragraph{{DeliveredWords(*result.delivered)}, ""});
  }
  section.blocks.push_back(Paragraph{{IntervalWords(result, *fit)}, ""});
  const bool noise_free = result.noise_free;
  for (const Table& table : {UnitTable(*fit, Unit::kRadian, false, noise_free),
                             UnitTable(*fit, Unit::kMetre, false, noise_free),
                             UnitTable(*fit, Unit::kRadian, true, noise_free),
                             UnitTable(*fit, Unit::kMetre, true, noise_free),
                             EffectTable(*fit)}) {
    if (!table.rows.empty()) section.blocks.push_back(table);
  }
  const std::string held = HeldWords(*fit);
  if (!held.empty()) section.blocks.push_back(Paragraph{{held}, ""});
  return section;
}

}  // namespace dhcal
