#include "tools/proof/simulator/sensor.h"

#include <cmath>

namespace dhcal::concealed {
namespace {

double UnitNoise(bool heavy_tails, Rng* rng) {
  if (!heavy_tails) return rng->Normal();
  const double normal = rng->Normal();
  double square = 0;
  for (int k = 0; k < 3; ++k) square += std::pow(rng->Normal(), 2);
  // Student's t with 3 degrees of freedom has the variance 3.
  return normal / std::sqrt(square / 3) / std::sqrt(3.0);
}

}  // namespace

Eigen::MatrixXd Read(const Sensor& sensor, const Eigen::MatrixXd& positions, Rng* rng) {
  Eigen::MatrixXd readings = (1 + sensor.scale) * positions;
  const double fresh = std::sqrt(1 - sensor.correlation * sensor.correlation);
  Eigen::RowVector3d error = Eigen::RowVector3d::Zero();
  for (Eigen::Index row = 0; row < readings.rows(); ++row) {
    const double keep = row == 0 ? 0 : sensor.correlation;
    const double add = row == 0 ? 1 : fresh;
    for (int k = 0; k < 3; ++k) {
      error[k] = keep * error[k] + add * UnitNoise(sensor.heavy_tails, rng);
    }
    readings.row(row) += sensor.noise * error;
    if (rng->Uniform(0, 1) < sensor.wrong_share) {
      const int axis = static_cast<int>(rng->Uniform(0, 3));
      const double lines = rng->Uniform(0, 1) < 0.5 ? -1 : 1;
      readings(row, axis) += lines * sensor.pitch;
    }
  }
  return (readings / sensor.resolution).array().round().matrix() * sensor.resolution;
}

}  // namespace dhcal::concealed
