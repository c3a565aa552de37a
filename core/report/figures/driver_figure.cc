// What is left of the readings over whatever may drive it, and the joint angles that were visited.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "core/base/units.h"
#include "core/report/figures/figures.h"
#include "core/report/figures/thinned.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostPointsOfDriver = 300;
constexpr std::size_t kMostDriverPlots = 15;

/// A column that may drive an error.
struct DriverColumn {
  Plot::Axis axis;
  Eigen::VectorXd values;  // as shown, one per row of the recording; NaN = blank
};

std::string AxisOfJoint(const RobotModel& robot, std::size_t joint) {
  const std::string& name = robot.joints[joint].name;
  return name.empty() ? fmt::format("joint {}", joint + 1)
                      : fmt::format("joint {} ({})", joint + 1, name);
}

bool Turns(const RobotModel& robot, std::size_t joint) {
  return robot.joints[joint].type == JointType::kRevolute;
}

DriverColumn JointColumn(const RobotModel& robot, const Recording& recording, std::size_t joint) {
  const bool turns = Turns(robot, joint);
  return {{AxisOfJoint(robot, joint), turns ? "deg" : "mm"},
          recording.q.col(static_cast<Eigen::Index>(joint)) / (turns ? kDegree : kMillimetre)};
}

void AddColumns(const std::string& name,
                const std::string& unit,
                const Eigen::MatrixXd& values,
                std::vector<DriverColumn>* all) {
  for (Eigen::Index k = 0; k < values.cols() && values.rows() > 0; ++k) {
    const std::string title = values.cols() == 1 ? name : fmt::format("{} {}", name, k + 1);
    all->push_back({{title, unit}, values.col(k)});
  }
}

/// Columns whose finite values differ.
bool Varies(const DriverColumn& column) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : column.values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return high > low;
}

std::vector<DriverColumn> DriversOf(const ProblemSpec& spec, const Recording& recording) {
  std::vector<DriverColumn> all;
  for (std::size_t joint = 0; joint < spec.robot.joints.size(); ++joint) {
    all.push_back(JointColumn(spec.robot, recording, joint));
  }
  AddColumns("time", "s", recording.time, &all);
  AddColumns("payload", "kg", recording.payload, &all);
  AddColumns("temperature", "degC", recording.temperature, &all);
  for (const ExtraColumn& extra : recording.extra) {
    AddColumns(extra.name, "", extra.values, &all);
  }
  AddColumns("torque of joint", "N m", recording.torque, &all);
  const auto idle = [](const DriverColumn& column) { return !Varies(column); };
  all.erase(std::remove_if(all.begin(), all.end(), idle), all.end());
  return all;
}

/// Residuals of the lengths [mm], a series per coordinate, over a column.
Plot OverDriver(const Result& result,
                const std::vector<const RowResidual*>& rows,
                const DriverColumn& column,
                std::size_t step) {
  Plot plot;
  plot.x = column.axis;
  plot.y = {"residual", "mm"};
  for (int k = 0; k < result.kind.num_lengths(); ++k) {
    Plot::Series series;
    series.name = result.coordinate_names[static_cast<std::size_t>(k)];
    series.mark = Plot::Mark::kPoints;
    for (std::size_t i = 0; i < rows.size(); i += step) {
      const double value = column.values[rows[i]->row_idx];
      if (!std::isfinite(value)) continue;
      series.x.push_back(value);
      series.y.push_back(rows[i]->residual[k] / kMillimetre);
    }
    if (!series.x.empty()) plot.series.push_back(series);
  }
  return plot;
}

}  // namespace

Figure DriverFigure(const ProblemSpec& spec, const Recording& recording, const Result& result) {
  std::vector<const RowResidual*> rows;
  const auto lengths = static_cast<std::size_t>(result.kind.num_lengths());
  if (result.coordinate_names.size() < lengths) return {};
  for (const RowResidual& row : result.residuals) {
    const bool known = row.residual.size() >= static_cast<Eigen::Index>(lengths);
    if (known && row.set_aside.empty() && row.row_idx < recording.num_rows()) rows.push_back(&row);
  }
  if (rows.size() < 3) return {};
  const Thinned thinned(rows.size(), kMostPointsOfDriver);
  std::vector<DriverColumn> drivers = DriversOf(spec, recording);
  const std::size_t left_out = drivers.size() - std::min(drivers.size(), kMostDriverPlots);
  drivers.resize(drivers.size() - left_out);
  Figure figure;
  for (const DriverColumn& driver : drivers) {
    Plot plot = OverDriver(result, rows, driver, thinned.step);
    if (!plot.series.empty()) figure.plots.push_back(std::move(plot));
  }
  figure.caption = fmt::format(
      "What calibrated.yaml leaves of the readings, over each joint and what else was recorded: a "
      "curve or a slope is something not explained, an even cloud is noise.{}{}",
      thinned.Words("row"),
      left_out > 0 ? fmt::format(" {} further columns are not drawn.", left_out) : "");
  return figure;
}

Figure RangeFigure(const ProblemSpec& spec, const Recording& recording) {
  const std::size_t joints = spec.robot.joints.size();
  const auto rows = static_cast<std::size_t>(recording.num_rows());
  if (rows == 0 || recording.q.cols() != static_cast<Eigen::Index>(joints)) return {};
  const Thinned thinned(rows, kMostPointsOfDriver);
  Figure figure;
  for (const bool turning : {true, false}) {
    Plot plot;
    plot.lying = true;
    plot.x.title = "";
    plot.y = turning ? Plot::Axis{"joint angle, as reported", "deg"}
                     : Plot::Axis{"stroke, as reported", "mm"};
    Plot::Series visited;
    visited.mark = Plot::Mark::kPoints;
    for (std::size_t joint = 0; joint < joints; ++joint) {
      if (Turns(spec.robot, joint) != turning) continue;
      const auto position = static_cast<double>(plot.x.names.size());
      const DriverColumn column = JointColumn(spec.robot, recording, joint);
      plot.x.names.push_back(column.axis.title);
      for (std::size_t i = 0; i < rows; i += thinned.step) {
        visited.x.push_back(position);
        visited.y.push_back(column.values[static_cast<Eigen::Index>(i)]);
      }
    }
    if (visited.x.empty()) continue;
    plot.series = {visited};
    figure.plots.push_back(plot);
  }
  figure.caption =
      "Joint positions of the recording: the calibration is tested there, and extrapolated "
      "elsewhere." +
      thinned.Words("row");
  return figure;
}

}  // namespace dhcal
