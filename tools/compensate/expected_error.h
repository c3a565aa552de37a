// What a calibration's covariance lets expect of the pose that its model predicts.
#ifndef DHCAL_TOOLS_COMPENSATE_EXPECTED_ERROR_H_
#define DHCAL_TOOLS_COMPENSATE_EXPECTED_ERROR_H_

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/diagnostics.h"
#include "tools/compensate/real_arm.h"

namespace dhcal {

/// Estimated parameters of a result and their covariance, SI, in the same order.
struct ParameterCovariance {
  std::vector<std::string> names;
  Eigen::MatrixXd covariance;
};

/// Of the model that calibrated.yaml holds: `delivered`, else the best fit. Nothing where the file
/// has none; an error is added where it is there and cannot be read.
std::optional<ParameterCovariance> ReadCovariance(const std::string& result_json,
                                                  Diagnostics* diagnostics);

/// One sigma of the position predicted for every row [m], 3-D: the root of the trace of
/// J C J'. Of the calibration's parameters alone: not the robot's repeatability, nor what the model
/// leaves out. Nothing where the result knows the base in the frames of edges only.
std::optional<Eigen::VectorXd> ExpectedErrors(const ProblemSpec& spec,
                                              const Recording& rows,
                                              const RealArm& arm,
                                              const Eigen::MatrixXd& q,
                                              const ParameterCovariance& known);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_COMPENSATE_EXPECTED_ERROR_H_
