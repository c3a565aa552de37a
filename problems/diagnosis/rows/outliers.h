// Readings that no part of the model describes, decided anew at each model, fitted and test rows
// alike.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_ROWS_OUTLIERS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_ROWS_OUTLIERS_H_

#include <vector>

#include <Eigen/Core>

namespace dhcal {

/// Whitened residual of every reading at a model.
struct ReadingResiduals {
  int coordinates = 3;
  Eigen::VectorXd fitted, test;  // coordinate by coordinate
  Eigen::VectorXd leverage;      // of the fitted readings, mean over coordinates; empty = none
};

struct Outliers {
  std::vector<bool> fitted, test;  // by reading
  double scale = 1;                // robust standard deviation of the fitted, in units of the rows'
  int count() const;
};

/// Beyond kTuning.outlier_sigmas robust standard deviations (not below 1 where sigma is known); at
/// most kTuning.most_outliers of all, the worst.
Outliers FindOutliers(const ReadingResiduals& residuals, bool sigma_known);

/// Squares of one reading, in full up to a bound and by their logarithm beyond: one misread row
/// must not outvote all others.
double BoundedSquare(double square);

/// Median of squared lengths in units of what unit noise has.
double RobustVariance(const Eigen::VectorXd& residuals, int coordinates);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_ROWS_OUTLIERS_H_
