// The instrument that reads the tool point, and its faults.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_SENSOR_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_SENSOR_H_

#include <Eigen/Core>

#include "core/base/rng.h"

namespace dhcal::concealed {

struct Sensor {
  double noise = 0;          // [m] of one coordinate
  bool heavy_tails = false;  // Student's t with 3 degrees of freedom, of the same deviation
  double correlation = 0;    // lag-1, AR(1)
  double wrong_share = 0;    // share of readings at a wrong graduation
  double pitch = 1e-3;       // [m] of the graduation
  double scale = 0;          // relative error of all lengths
  double resolution = 1e-6;  // [m] of what it displays
};

/// Readings (poses x 3) of true positions [m].
Eigen::MatrixXd Read(const Sensor& sensor, const Eigen::MatrixXd& positions, Rng* rng);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_SENSOR_H_
