// Errors of single joints, over their angle and by order.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "core/base/units.h"
#include "core/math/nonuniform_fourier.h"
#include "core/report/figures/figures.h"
#include "core/report/figures/thinned.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostPointsOfJoint = 600;
constexpr std::size_t kFewestForOrders = 60;  // rows; fewer show nothing but noise
constexpr int kMostOrders = 200;              // per turn: beyond usual gear ratios
constexpr double kMilliOf = 1e-3;             // [SI] errors are told in mrad and mm

bool IsRevolute(const ProblemSpec& spec, const JointErrors& errors) {
  return spec.robot.joints[static_cast<std::size_t>(errors.joint_idx)].type == JointType::kRevolute;
}

Plot ErrorsOverAngle(const ProblemSpec& spec, const JointErrors& errors, std::size_t step) {
  const bool turns = IsRevolute(spec, errors);
  Plot plot;
  plot.title = JointWords(spec.robot, errors.joint_idx + 1);
  plot.x = {turns ? "joint angle, as reported" : "stroke, as reported", turns ? "deg" : "mm"};
  plot.y = {turns ? "error of the angle" : "error of the stroke", turns ? "mrad" : "mm"};
  Plot::Series seen{"readings"}, modelled{"model"};
  seen.tone = Plot::Tone::kMuted;
  modelled.tone = Plot::Tone::kAfter;
  for (Plot::Series* const series : {&seen, &modelled}) series->mark = Plot::Mark::kPoints;
  for (std::size_t i = 0; i < errors.q.size(); i += step) {
    const double q = errors.q[i] / (turns ? kDegree : kMillimetre);
    seen.x.push_back(q);
    seen.y.push_back(errors.error[i] / kMilliOf);
    modelled.x.push_back(q);
    modelled.y.push_back(errors.modelled[i] / kMilliOf);
  }
  plot.series = {seen, modelled};
  return plot;
}

/// Amplitudes of the whole orders 1 ... kMostOrders of `values` over the angle.
Plot::Series Amplitudes(const std::string& name,
                        const Eigen::VectorXd& values,
                        const NonuniformFourier& fourier) {
  Plot::Series series{name};
  series.mark = Plot::Mark::kCurve;
  const Eigen::ArrayXcd sums = fourier.Sums(values.array() - values.mean());
  for (int order = 1; order <= kMostOrders; ++order) {
    series.x.push_back(order);
    series.y.push_back(2 * std::abs(sums[order]) / static_cast<double>(values.size()) / kMilliOf);
  }
  return series;
}

Plot OrdersOf(const ProblemSpec& spec, const JointErrors& errors) {
  const auto as_vector = [](const std::vector<double>& v) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), Eigen::Index(v.size())));
  };
  const Eigen::VectorXd error = as_vector(errors.error);
  const NonuniformFourier fourier(as_vector(errors.q), kMostOrders + 1);
  Plot plot;
  plot.title = JointWords(spec.robot, errors.joint_idx + 1);
  plot.x = {"cycles per revolution of the joint", ""};
  plot.y = {"amplitude", "mrad"};
  plot.series = {Amplitudes("without the model", error, fourier),
                 Amplitudes("what the model leaves", error - as_vector(errors.modelled), fourier)};
  plot.series[0].tone = Plot::Tone::kBefore;
  plot.series[1].tone = Plot::Tone::kAfter;
  return plot;
}

}  // namespace

Figure JointErrorFigure(const ProblemSpec& spec, const Result& result) {
  if (!result.delivered) return {};
  Figure figure;
  std::size_t most = 0;
  for (const JointErrors& errors : result.delivered->joint_errors) {
    if (errors.q.empty()) continue;
    most = std::max(most, errors.q.size());
  }
  const Thinned thinned(most, kMostPointsOfJoint);
  for (const JointErrors& errors : result.delivered->joint_errors) {
    if (!errors.q.empty()) figure.plots.push_back(ErrorsOverAngle(spec, errors, thinned.step));
  }
  figure.caption =
      "How the joints with effects err, each reading taken as an error of that joint alone (grey), "
      "and what the effects found say (colour): the colour should run through the middle of the "
      "grey." +
      thinned.Words("row");
  return figure;
}

Figure OrderFigure(const ProblemSpec& spec, const Result& result) {
  if (!result.delivered) return {};
  Figure figure;
  for (const JointErrors& errors : result.delivered->joint_errors) {
    if (!IsRevolute(spec, errors) || errors.q.size() < kFewestForOrders) continue;
    figure.plots.push_back(OrdersOf(spec, errors));
  }
  figure.caption =
      "Periodic parts of the same errors by their order: a line that stands out is a gear or "
      "bearing that turns so often per revolution. Lines that only the first curve has are in the "
      "model.";
  return figure;
}

}  // namespace dhcal
