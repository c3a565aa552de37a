// calibration.conf of a Universal Robots controller: what its factory calibration adds to the rows.
#ifndef DHCAL_PROBLEMS_FORMATS_EXCHANGE_UR_CALIBRATION_H_
#define DHCAL_PROBLEMS_FORMATS_EXCHANGE_UR_CALIBRATION_H_

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/robot.h"

namespace dhcal {

/// One number per joint, to be added to a standard row.
struct UrCalibration {
  std::vector<double> theta, a, d, alpha;  // [rad] [m] [m] [rad]
};

/// Reads the lists `delta_theta`, `delta_a`, `delta_d` and `delta_alpha` of the section `mounting`;
/// other keys are the controller's own.
std::optional<UrCalibration> ReadUrCalibration(const std::string& file, Diagnostics* diagnostics);

/// Adds it to standard rows; an error at `where` when their number is another.
void AddUrCalibration(const UrCalibration& calibration,
                      const SourceLocation& where,
                      RobotModel* robot,
                      Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_EXCHANGE_UR_CALIBRATION_H_
