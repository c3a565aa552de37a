// Corrections of the robot's numbers.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/report/figures/figures.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostCorrections = 60;  // of one plot
constexpr double kMicro = 1e-6;               // [rad] or [m]

/// Corrections of the robot's angles or lengths; without series where there are none.
Plot CorrectionsOf(const FitResult& fit, Unit unit, bool noise_free) {
  const bool angle = unit == Unit::kRadian;
  const double size = noise_free ? kMicro : angle ? kMilliradian : kMillimetre;
  Plot plot;
  plot.lying = true;
  plot.title = angle ? "angles" : "lengths";
  plot.y = {"correction", angle ? (noise_free ? "urad" : "mrad") : (noise_free ? "um" : "mm")};
  Plot::Series known{"measured by itself"}, other{"not measurable by itself"};
  known.tone = Plot::Tone::kAfter;
  other.tone = Plot::Tone::kMuted;
  for (const ParameterResult& p : fit.parameters) {
    const bool frame = StartsWith(p.name, "base_") || StartsWith(p.name, "tool_");
    if (p.unit != unit || frame || p.verdict == Verdict::kFixed) continue;
    if (!std::isfinite(p.correction) || !std::isfinite(p.sigma)) continue;
    if (plot.x.names.size() == kMostCorrections) break;
    Plot::Series& series = p.verdict == Verdict::kIdentified ? known : other;
    series.mark = Plot::Mark::kPoints;
    series.x.push_back(static_cast<double>(plot.x.names.size()));
    series.y.push_back(p.correction / size);
    series.sigma.push_back(p.sigma / size);
    plot.x.names.push_back(p.name);
  }
  for (const Plot::Series& series : {known, other}) {
    if (!series.x.empty()) plot.series.push_back(series);
  }
  return plot;
}

}  // namespace

Figure CorrectionFigure(const Result& result) {
  const FitResult* const fit = result.delivered_fit();
  if (fit == nullptr) return {};
  const IntervalVerdict intervals =
      result.delivered ? result.delivered->intervals : result.intervals;
  Figure figure;
  for (const Unit unit : {Unit::kRadian, Unit::kMetre}) {
    Plot plot = CorrectionsOf(*fit, unit, result.noise_free);
    if (!plot.series.empty()) figure.plots.push_back(plot);
  }
  figure.caption = fmt::format(
      "Corrections of the robot's numbers with 95 % intervals{}: where an interval spans zero, the "
      "drawing may be right. Grey ones are not to be read one by one.",
      intervals == IntervalVerdict::kHold ? ""
                                          : " (which do not hold here: the model is not complete)");
  return figure;
}

}  // namespace dhcal
