// The rows that a diagnosis judges by: without the ones that lie off, the model taken out.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_CLEAN_ROWS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_CLEAN_ROWS_H_

#include <memory>
#include <set>
#include <vector>

#include <Eigen/Core>

#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/design_rows.h"

namespace dhcal {

/// Rows of a fit with its geometry and effects taken out.
struct CleanRows {
  std::vector<Reading> readings;
  std::unique_ptr<DesignRows> rows;
  Eigen::MatrixXd U;  // orthonormal basis of what the model can do
  Eigen::VectorXd y;  // whitened residuals without it
  double nu = 0;      // freedom of y
  double rms = 0;     // [m] of y as it was read, before any serial whitening
};

CleanRows TakeOutModel(const CompleteFit& fit, const std::vector<Reading>& readings);

/// Root mean square of what a fit leaves of some readings, as they were read [m].
double RmsOfReadings(const CompleteFit& fit, const std::vector<Reading>& readings);

/// Takes a lag-1 correlation out of rows that are clean already.
void WhitenSerially(const CompleteFit& fit, double rho, CleanRows* clean);

/// Readings without those of some rows of the recording. Of differences between shared poses that
/// were read as positions, one leads over the gap.
std::vector<Reading> WithoutRows(const Calibration& calibration,
                                 const std::vector<Reading>& readings,
                                 const std::set<int>& rows);

/// Rows of the recording whose readings lie off by more than noise from what the fit's geometry and
/// effects can do.
std::set<int> RowsThatLieOff(const CompleteFit& fit, const std::vector<Reading>& readings);

/// Test rows that lie off, by the same rule, from geometry and effects and from the geometry alone
/// as well: a row that only the effects miss is a prediction that failed, not a misreading.
std::set<int> MisreadTestRows(const CompleteFit& before, const CompleteFit& after);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_CLEAN_ROWS_H_
