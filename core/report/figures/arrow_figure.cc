// Errors over the workspace.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "core/base/units.h"
#include "core/kinematics/dh_chain.h"
#include "core/report/figures/figures.h"
#include "core/report/figures/thinned.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostArrows = 250;
constexpr double kArrowShare = 0.08;  // of the workspace, for an arrow longer than nine of ten
constexpr double kNineOfTen = 0.9;

struct ErrorAtPoint {
  Eigen::Vector3d p;              // [mm] where
  Eigen::Vector3d before, after;  // [mm]
};

/// Where the point of a row stands: as measured or, where only its displacement was, as the nominal
/// robot has it.
Eigen::Vector3d PlaceOf(const ProblemSpec& spec,
                        const DhChain& chain,
                        const Recording& recording,
                        const RowResidual& row) {
  if (!spec.measurement.kind.pairs) return row.measured.head<3>() / kMillimetre;
  const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(chain.slots().size());
  const EndFrames ends{spec.robot.X_WB, spec.robot.X_TQ};
  const Eigen::VectorXd q = recording.q.row(row.row_idx).transpose();
  return chain.Pose<double>(q, nominal, ends).translation() / kMillimetre;
}

std::vector<ErrorAtPoint> ErrorsAtPoints(const ProblemSpec& spec,
                                         const Recording& recording,
                                         const Result& result) {
  const DhChain chain(spec.robot);
  std::vector<ErrorAtPoint> errors;
  for (const RowResidual& row : result.residuals) {
    if (!row.set_aside.empty() || row.predicted_before.size() < 3) continue;
    if (row.row_idx < 0 || row.row_idx >= recording.num_rows()) continue;
    errors.push_back({PlaceOf(spec, chain, recording, row),
                      (row.measured - row.predicted_before).head<3>() / kMillimetre,
                      row.residual.head<3>() / kMillimetre});
  }
  return errors;
}

/// 1, 2 or 5 times a power of ten, at most `value`.
double RoundDown(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  const double digit = value / power;
  return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

/// How many times the arrows are longer than the errors.
double Magnification(const std::vector<ErrorAtPoint>& errors,
                     Eigen::Vector3d ErrorAtPoint::*which) {
  Eigen::Vector3d low = errors.front().p, high = errors.front().p;
  std::vector<double> sizes;
  for (const ErrorAtPoint& e : errors) {
    low = low.cwiseMin(e.p);
    high = high.cwiseMax(e.p);
    sizes.push_back((e.*which).norm());
  }
  const auto at =
      sizes.begin() + static_cast<long>(kNineOfTen * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  const double extent = (high - low).maxCoeff();
  return *at > 0 && extent > 0 ? RoundDown(kArrowShare * extent / *at) : 1;
}

/// A direction to look along, and what is seen to the right and upward.
struct View {
  const char* name;
  int right, up;  // coordinates
};
constexpr std::array<View, 3> kViews = {
    {{"from above", 0, 1}, {"along y", 0, 2}, {"along x", 1, 2}}};
constexpr std::array<const char*, 3> kCoordinates = {"x", "y", "z"};

Plot ViewOf(const std::vector<ErrorAtPoint>& errors,
            Eigen::Vector3d ErrorAtPoint::*which,
            const View& view,
            std::size_t step) {
  const bool is_before = which == &ErrorAtPoint::before;
  const double times = Magnification(errors, which);
  Plot plot;
  plot.title =
      fmt::format("{}, {} (arrows {:g} times)", is_before ? "before" : "after", view.name, times);
  plot.x = {kCoordinates[static_cast<std::size_t>(view.right)], "mm"};
  plot.y = {kCoordinates[static_cast<std::size_t>(view.up)], "mm"};
  plot.same_scale = true;
  Plot::Series series;
  series.mark = Plot::Mark::kArrows;
  series.tone = is_before ? Plot::Tone::kBefore : Plot::Tone::kAfter;
  for (std::size_t i = 0; i < errors.size(); i += step) {
    const ErrorAtPoint& e = errors[i];
    series.x.push_back(e.p[view.right]);
    series.y.push_back(e.p[view.up]);
    series.dx.push_back(times * (e.*which)[view.right]);
    series.dy.push_back(times * (e.*which)[view.up]);
  }
  plot.series = {series};
  return plot;
}

}  // namespace

Figure ArrowFigure(const ProblemSpec& spec, const Recording& recording, const Result& result) {
  if (!result.kind.is_point() || result.best() == nullptr) return {};
  const std::vector<ErrorAtPoint> errors = ErrorsAtPoints(spec, recording, result);
  if (errors.size() < 3) return {};
  const Thinned thinned(errors.size(), kMostArrows);
  Figure figure;
  for (const auto which : {&ErrorAtPoint::before, &ErrorAtPoint::after}) {
    for (const View& view : kViews) {
      figure.plots.push_back(ViewOf(errors, which, view, thinned.step));
    }
  }
  figure.caption = fmt::format(
      "Errors over the workspace{}, as arrows (measured minus predicted), magnified as each title "
      "says. Neighbours that point the same way have a common cause; after a good calibration they "
      "point anywhere.{}",
      spec.measurement.kind.pairs ? ", which are displacements, at the points that the nominal "
                                    "robot reaches"
                                  : "",
      thinned.Words("row"));
  return figure;
}

}  // namespace dhcal
