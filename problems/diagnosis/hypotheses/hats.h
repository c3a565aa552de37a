// Piecewise linear functions of a driver.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_HATS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_HATS_H_

#include <vector>

#include <Eigen/Core>

namespace dhcal {

/// Functions that are 1 at one knot and 0 at the others, per value: values x knots.
Eigen::MatrixXd Hats(const Eigen::VectorXd& values, const std::vector<double>& knots);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_HATS_H_
