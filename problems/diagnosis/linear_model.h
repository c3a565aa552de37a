// A fit's rows as a linear model of all its unknowns, as sums of products: thousands of rows, a few
// hundred unknowns, solved again and again for other rows and other sets of effects.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_LINEAR_MODEL_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_LINEAR_MODEL_H_

#include <vector>

#include <Eigen/Core>

#include "problems/calibration.h"

namespace dhcal {

/// A x = y: unknowns in their tolerances, rows in the noise. Geometry counts from the state,
/// effects count from zero, so that what the rows do not determine stays at no effect.
struct LinearModel {
  LinearModel(const Calibration& calibration, const Eigen::VectorXd& state, const Noise& noise);

  Eigen::MatrixXd A;
  Eigen::VectorXd y;
  Eigen::VectorXd tolerance;       // of the calibration's parameters, SI; A may have more columns
  std::vector<int> recording_row;  // of each row
};

/// A'A and A'y of some rows (of all where the list is empty). With unknowns in tolerances their
/// square root's worst condition number is far from the limit of double precision.
struct NormalEquations {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
};
NormalEquations NormalEquationsOf(const LinearModel& model, const std::vector<int>& rows);

/// The x that fits best with the tolerances as priors; `kept`: its unknowns, the others are zero.
/// `variance`: of a row, where the whitening is not right yet.
Eigen::VectorXd Solve(const NormalEquations& normal,
                      const std::vector<int>& kept,
                      double variance = 1);

/// Covariance of all unknowns from their A'A, in tolerances.
Eigen::MatrixXd Covariance(Eigen::MatrixXd H);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_LINEAR_MODEL_H_
