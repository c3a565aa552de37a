// The diagnosis' evidence.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/effect.h"
#include "core/report/figures/figures.h"
#include "core/report/format.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostBars = 12;
// Parts of the largest size at which the map's next shade begins.
constexpr std::array<double, Plot::kShades> kShadeFrom = {0, 0.25, 0.5, 0.75};

/// Where a name stands among the others; it is added where it is new.
double PositionOf(const std::string& name, std::vector<std::string>* names) {
  const auto at = std::find(names->begin(), names->end(), name);
  const auto position = static_cast<double>(at - names->begin());
  if (at == names->end()) names->push_back(name);
  return position;
}

Plot LyingBars(const Plot::Axis& axis, Plot::Tone tone) {
  Plot plot;
  plot.lying = true;
  plot.y = axis;
  Plot::Series series;
  series.mark = Plot::Mark::kBars;
  series.tone = tone;
  plot.series = {series};
  return plot;
}

void AddBar(const std::string& name, double value, Plot* plot) {
  plot->series[0].x.push_back(static_cast<double>(plot->x.names.size()));
  plot->series[0].y.push_back(value);
  plot->x.names.push_back(name);
}

Plot EvidencePlot(const std::vector<Finding>& findings) {
  Plot plot = LyingBars({"difference of BIC", ""}, Plot::Tone::kAfter);
  for (const Finding& finding : findings) {
    if (!std::isfinite(finding.delta_bic) || plot.x.names.size() == kMostBars) continue;
    AddBar(InstanceName(finding.effect), finding.delta_bic, &plot);
  }
  return plot;
}

Plot AlternativesPlot(const std::vector<Finding>& findings) {
  Plot plot = LyingBars({"likeness", ""}, Plot::Tone::kMuted);
  for (const Finding& finding : findings) {
    for (const Confusable& other : finding.confusable_with) {
      if (!std::isfinite(other.overlap) || plot.x.names.size() == kMostBars) continue;
      AddBar(InstanceName(other.effect), std::abs(other.overlap), &plot);
    }
  }
  return plot;
}

}  // namespace

Figure MapFigure(const DiagnosisResult& diagnosis) {
  double largest = 0;
  for (const MapEntry& entry : diagnosis.map) {
    if (std::isfinite(entry.rms)) largest = std::max(largest, entry.rms);
  }
  if (!(largest > 0)) return {};
  Plot plot;
  plot.lying = true;
  plot.x.title = "where";
  plot.y.title = "driven by";
  std::vector<Plot::Series> shades;
  for (int shade = 1; shade <= Plot::kShades; ++shade) {
    Plot::Series series;
    series.mark = Plot::Mark::kCells;
    series.shade = shade;
    const double from = kShadeFrom[static_cast<std::size_t>(shade - 1)] * largest / kMillimetre;
    series.name = fmt::format("> {:.2g} mm", from);
    shades.push_back(series);
  }
  for (const MapEntry& entry : diagnosis.map) {
    if (!std::isfinite(entry.rms)) continue;
    const auto above = std::upper_bound(kShadeFrom.begin(), kShadeFrom.end(), entry.rms / largest);
    Plot::Series& series = shades[static_cast<std::size_t>(above - kShadeFrom.begin()) - 1];
    series.x.push_back(PositionOf(entry.slot, &plot.x.names));
    series.y.push_back(PositionOf(entry.driver, &plot.y.names));
  }
  for (const Plot::Series& series : shades) {
    if (!series.x.empty()) plot.series.push_back(series);
  }
  return {
      "Mismatch map: how much of the residuals of the geometry (RMS) each place, driven by each "
      "cause, would take away alone. The strongest cells only; those of one cause resemble each "
      "other, so neighbours light up with it.",
      {plot}};
}

Figure EvidenceFigure(const DiagnosisResult& diagnosis) {
  Figure figure;
  const Plot evidence = EvidencePlot(diagnosis.findings);
  const Plot alternatives = AlternativesPlot(diagnosis.findings);
  for (const Plot* const plot : {&evidence, &alternatives}) {
    if (!plot->x.names.empty()) figure.plots.push_back(*plot);
  }
  figure.caption = "Evidence for each finding (difference of BIC: 10 is strong)";
  figure.caption += alternatives.x.names.empty()
                        ? "."
                        : ", and how alike other effects are to a finding at these poses (1: they "
                          "cannot be told apart).";
  return figure;
}

Figure HiddenFigure(const DiagnosisResult& diagnosis) {
  Plot plot = LyingBars({"error elsewhere", "mm"}, Plot::Tone::kMuted);
  for (const HiddenRisk& risk : diagnosis.hidden) {
    if (!std::isfinite(risk.risk) || plot.x.names.size() == kMostBars) continue;
    AddBar(InstanceName(risk.effect), risk.risk / kMillimetre, &plot);
  }
  if (plot.x.names.empty()) return {};
  return {
      "Detection limits: the error (3-D) that an effect too small to be found here could still "
      "cause at other poses, at most (95 %).",
      {plot}};
}

}  // namespace dhcal
