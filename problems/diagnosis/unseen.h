// Prediction of rows that were not fitted: whole regions of the joint space, runs, or the rows that
// the recording marks as test. Random folds would leave neighbours of every row in the fit and
// hide what matters (PHYSICS.md M6).
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_UNSEEN_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_UNSEEN_H_

#include <string>
#include <vector>

#include <Eigen/Core>

#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/linear_model.h"

namespace dhcal {

struct Folds {
  std::string method;       // "runs left out", "regions left out"
  std::vector<int> of_row;  // fold of each row of the recording, counted from 0
  int count = 0;
};

/// Folds of the recording's rows: by run where there are three or more, else five regions of the
/// joint space (k-means).
Folds MakeFolds(const Calibration& calibration);

/// Predictions by the linear model at a fit, prepared once for all effects that are left out in
/// turn. Unknowns have their tolerances as priors.
class LeftOutRows {
 public:
  LeftOutRows(const CompleteFit& fit, const Folds& folds);

  /// Residuals of each reading predicted from the other folds; whitened, rows as in DesignRows
  /// (with shared poses, each series has one more than it has readings). `dropped` (may be empty):
  /// effect columns that the model may not use.
  Eigen::VectorXd Residuals(const std::vector<int>& dropped) const;
  /// The same rows as fitted.
  Eigen::VectorXd Fitted(const std::vector<int>& dropped) const;
  /// Squares of `Residuals` at a cost that does not depend on the rows.
  double Squares(const std::vector<int>& dropped) const;
  /// Row of the recording of each of these residuals.
  const std::vector<int>& recording_row() const { return model_.recording_row; }

 private:
  std::vector<int> Kept(const std::vector<int>& dropped) const;
  bool IsPredicted(std::size_t fold) const;

  LinearModel model_;
  std::vector<int> unknown_of_effect_;  // position of each effect column among the unknowns
  std::vector<std::vector<int>> rows_;  // of each fold
  std::vector<NormalEquations> folds_;
  std::vector<double> fold_squares_;  // y'y of each fold
  NormalEquations all_;
  mutable std::vector<Eigen::MatrixXd> covariances_;  // without each fold; made when asked for
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_UNSEEN_H_
