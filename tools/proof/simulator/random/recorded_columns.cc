#include "tools/proof/simulator/random/recorded_columns.h"

#include <cmath>
#include <string>

#include "tools/proof/simulator/random/draw.h"

namespace dhcal::concealed {
namespace {

using Eigen::VectorXd;

constexpr double kSome = 0.4;        // of the trials have columns
constexpr double kReadNoise = 0.02;  // of the course's deviation

/// Heat that comes and goes: dx/dt = (source - x) / lag, where the source is switched by chance.
VectorXd Temperature(const VectorXd& time, Rng* rng) {
  const double duration = time[time.size() - 1];
  const double lag = duration * rng->Uniform(0.02, 0.2);
  VectorXd course(time.size());
  double state = rng->Uniform(0, 1), source = 1, until = 0;
  for (Eigen::Index row = 0; row < time.size(); ++row) {
    if (time[row] >= until) {
      source = rng->Uniform(0, 1);
      until = time[row] + duration * rng->Uniform(0.03, 0.15);
    }
    const double step = row > 0 ? time[row] - time[row - 1] : 0;
    state += (source - state) * (1 - std::exp(-step / lag));
    course[row] = state;
  }
  return course;
}

/// Another value at each row.
VectorXd Load(Eigen::Index rows, Rng* rng) {
  VectorXd course(rows);
  for (double& value : course) value = rng->Uniform(0, 1);
  return course;
}

/// Of zero mean and unit deviation.
VectorXd Standardised(const VectorXd& course) {
  const VectorXd centred = course.array() - course.mean();
  return centred / std::sqrt(centred.squaredNorm() / static_cast<double>(course.size()));
}

}  // namespace

std::vector<RecordedColumn> DrawColumns(const RandomTrial& trial, Rng* rng) {
  std::vector<RecordedColumn> columns;
  if (!Chance(kSome, rng)) return columns;
  const std::vector<std::string> names = {"motor_temp", "cabinet_humidity", "air_pressure"};
  const int count = 1 + DrawInt(static_cast<int>(names.size()), rng);
  for (int k = 0; k < count; ++k) {
    RecordedColumn column;
    column.name = names[static_cast<std::size_t>(k)];
    const Motion& motion = trial.motion;
    column.course = Standardised(Chance(0.6, rng) ? Temperature(motion.time, rng)
                                                  : Load(motion.num_poses(), rng));
    // Nobody knows its unit.
    const double middle = rng->Uniform(-100, 100), size = DrawLogUniform(0.1, 100, rng);
    column.decimals = static_cast<int>(std::ceil(2 - std::log10(size)));
    column.read.resize(column.course.size());
    for (Eigen::Index row = 0; row < column.read.size(); ++row) {
      column.read[row] = middle + size * (column.course[row] + kReadNoise * rng->Normal());
    }
    columns.push_back(column);
  }
  return columns;
}

}  // namespace dhcal::concealed
