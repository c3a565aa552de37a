// Prediction of rows that were not fitted: whole regions of the joint space, runs, or the rows that
// the recording marks as test. Random folds would leave neighbours of every row in the fit and
// hide what matters (physics.md B.1).
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_UNSEEN_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_UNSEEN_H_

#include <string>
#include <vector>

#include <Eigen/Core>

#include "problems/diagnosis/complete_fit.h"

namespace dhcal {

struct Folds {
  std::string method;       // "set column", "runs left out", "regions left out"
  std::vector<int> of_row;  // fold of each row of the recording, counted from 0
  int count = 0;
};

/// Folds of the recording's rows: by run where there are three or more, else five regions of the
/// joint space (k-means).
Folds MakeFolds(const Calibration& calibration);

/// Residuals of each reading predicted by the linear model of the other folds; whitened, rows as in
/// the calibration's readings. Directions that the others do not determine beyond the tolerances
/// are left at the fit (noise rule). `dropped` (empty = none): effect columns that the model is
/// not allowed to use; their part is put back into the readings.
Eigen::VectorXd LeftOutResiduals(const CompleteFit& fit,
                                 const Folds& folds,
                                 const std::vector<int>& dropped);

/// The same rows as fitted.
Eigen::VectorXd FittedResiduals(const CompleteFit& fit, const std::vector<int>& dropped);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_UNSEEN_H_
