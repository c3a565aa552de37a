// Errors of all rows before and after, in a histogram and over the rows' numbers.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/report/error_table.h"
#include "core/report/figures/figures.h"
#include "core/report/figures/thinned.h"
#include "core/report/format.h"

namespace dhcal {
namespace {

constexpr double kBinsPerDecade = 8;
constexpr double kMostDecades = 5;  // below the largest error; what is smaller is in the first bin
constexpr std::size_t kFewestRows = 5;
constexpr std::size_t kMostRowsDrawn = 600;

/// Error of a row [mm], rotations apart; NaN where it was not predicted.
double RowErrorBefore(const MeasurementKind& kind, const RowResidual& row) {
  const Eigen::Index lengths = kind.num_lengths();
  if (row.predicted_before.size() < lengths || row.measured.size() < lengths) return kNotSet;
  return (row.measured - row.predicted_before).head(lengths).norm() / kMillimetre;
}
double RowErrorAfter(const RowResidual& row) { return row.length / kMillimetre; }

struct ErrorsOfRows {
  std::vector<double> before, after;  // [mm]
};

ErrorsOfRows UsedErrors(const Result& result) {
  ErrorsOfRows errors;
  for (const RowResidual& row : result.residuals) {
    if (!row.set_aside.empty()) continue;
    const double before = RowErrorBefore(result.kind, row), after = RowErrorAfter(row);
    if (!std::isfinite(before) || !std::isfinite(after)) continue;
    errors.before.push_back(before);
    errors.after.push_back(after);
  }
  return errors;
}

/// Edges of bins that are equally wide on a logarithmic axis.
std::vector<double> BinEdges(const ErrorsOfRows& errors) {
  double largest = 0;
  for (const std::vector<double>* const all : {&errors.before, &errors.after}) {
    largest = std::max(largest, *std::max_element(all->begin(), all->end()));
  }
  if (!(largest > 0)) return {};
  double smallest = largest;
  for (const std::vector<double>* const all : {&errors.before, &errors.after}) {
    for (const double error : *all) {
      if (error > 0) smallest = std::min(smallest, error);
    }
  }
  smallest = std::max(smallest, largest * std::pow(10.0, -kMostDecades));
  const auto bin = [](double error) { return std::floor(kBinsPerDecade * std::log10(error)); };
  std::vector<double> edges;
  const auto first = static_cast<long>(bin(smallest)), last = static_cast<long>(bin(largest)) + 1;
  for (long k = first; k <= last; ++k) {
    edges.push_back(std::pow(10.0, static_cast<double>(k) / kBinsPerDecade));
  }
  return edges;
}

/// Share of the errors in each bin [%], and 0 at the last edge.
std::vector<double> SharesOf(const std::vector<double>& errors, const std::vector<double>& edges) {
  std::vector<double> shares(edges.size(), 0.0);
  for (const double error : errors) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), error) - edges.begin();
    const auto bin = std::clamp<std::ptrdiff_t>(above - 1, 0, std::ptrdiff_t(edges.size()) - 2);
    shares[static_cast<std::size_t>(bin)] += 100.0 / static_cast<double>(errors.size());
  }
  return shares;
}

void AddShares(const std::string& name,
               const std::vector<double>& errors,
               const std::vector<double>& edges,
               Plot::Tone tone,
               Plot* plot) {
  Plot::Series bars{name, edges, SharesOf(errors, edges)};
  bars.mark = Plot::Mark::kSteps;
  bars.tone = tone;
  Plot::Series sum{"", edges, {0}};
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) sum.y.push_back(sum.y[i] + bars.y[i]);
  sum.mark = Plot::Mark::kCurve;
  sum.tone = tone;
  sum.on_right = true;
  plot->series.push_back(bars);
  plot->series.push_back(sum);
}

/// One tone's points, of fitted or of unseen rows. A row without any error has no place on a
/// logarithmic axis.
void AddPoint(double row, double error, Plot::Series* series) {
  if (!(error > 0)) return;
  series->x.push_back(row);
  series->y.push_back(error);
}

Plot::Series PointSeries(const std::string& name, Plot::Tone tone) {
  Plot::Series series;
  series.name = name;
  series.mark = Plot::Mark::kPoints;
  series.tone = tone;
  return series;
}

}  // namespace

Figure ErrorFigure(const Result& result) {
  const ErrorsOfRows errors = UsedErrors(result);
  if (errors.before.size() < kFewestRows) return {};
  const std::vector<double> edges = BinEdges(errors);
  if (edges.empty()) return {};
  Plot plot;
  plot.x = {"error of a row", "mm", true};
  plot.y = {"rows in a bin", "%"};
  plot.y_right = Plot::Axis{"rows up to here", "%"};
  AddShares("before", errors.before, edges, Plot::Tone::kBefore, &plot);
  AddShares("after", errors.after, edges, Plot::Tone::kAfter, &plot);
  return {fmt::format(
              "Errors of all {} rows before (nominal robot{}) and after (calibrated.yaml): the "
              "further apart the two hills are, the more the calibration gained. Lines: share of "
              "rows with at most this error.",
              errors.before.size(),
              result.base_and_tool_only ? ", base and tool fitted" : ""),
          {plot}};
}

Figure RowFigure(const Result& result) {
  std::vector<const RowResidual*> rows;
  for (const RowResidual& row : result.residuals) {
    if (row.set_aside.empty() && std::isfinite(row.length)) rows.push_back(&row);
  }
  if (rows.size() < kFewestRows) return {};
  Plot::Series before = PointSeries("before", Plot::Tone::kBefore);
  Plot::Series fitted = PointSeries("after, fitted", Plot::Tone::kAfter);
  Plot::Series unseen = PointSeries("after, unseen", Plot::Tone::kOwn);
  const Thinned thinned(rows.size(), kMostRowsDrawn);
  for (std::size_t i = 0; i < rows.size(); i += thinned.step) {
    const RowResidual& row = *rows[i];
    const double number = row.row_idx + 1;
    AddPoint(number, RowErrorBefore(result.kind, row), &before);
    AddPoint(number, RowErrorAfter(row), row.test ? &unseen : &fitted);
  }
  Plot plot;
  plot.x = {"row of the recording", ""};
  plot.y = {"error", "mm", true};
  for (const Plot::Series& series : {before, fitted, unseen}) {
    if (!series.x.empty()) plot.series.push_back(series);
  }
  if (plot.series.empty()) return {};
  return {
      "Errors in the order of the rows: a slope or a step after calibration is something that "
      "changed while measuring." +
          thinned.Words("row"),
      {plot}};
}

}  // namespace dhcal
