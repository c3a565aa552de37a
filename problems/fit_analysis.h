// What a finished fit says about its parameters, rows and solvers.
#ifndef DHCAL_PROBLEMS_FIT_ANALYSIS_H_
#define DHCAL_PROBLEMS_FIT_ANALYSIS_H_

#include <optional>
#include <vector>

#include "core/analysis/ceres_covariance.h"
#include "core/analysis/identifiability.h"
#include "core/model/result.h"
#include "problems/calibration.h"
#include "problems/fit.h"

namespace dhcal {

/// The linear algebra at a usable fit's solution.
struct FitAnalysis {
  Identifiability identifiability;
  Noise noise;                          // that whitens the rows
  double degrees_of_freedom = kNotSet;  // of the noise estimate; infinite when given
  int num_residuals = 0;                // readings' coordinates, without priors
  double cost = kNotSet;                // at the solution, readings and priors
  CovarianceCheck covariance_check;
};

/// Rewhitens the fit's problem by the noise that its residuals show. Nothing where the solution
/// cannot be linearised.
std::optional<FitAnalysis> Analyse(const Calibration& calibration, const Fit& fit);

/// A fit as the result reports it; `nominal` is the robot of the problem file. Parameters are
/// filled only if the fit is usable.
FitResult DescribeFit(const Calibration& calibration, const Fit& fit, const FitAnalysis* analysis);

/// Corrections of both fits, their differences split by the first fit's null space.
std::vector<ComparedParameter> CompareFits(const Calibration& calibration,
                                           const Identifiability& identifiability,
                                           const Eigen::VectorXd& gauss_newton,
                                           const Eigen::VectorXd& levenberg_marquardt);

/// One entry per reading, fitted and test, in recording order; `before` is the calibration at the
/// start (nominal rows, base and tool aligned).
std::vector<RowResidual> DescribeRows(const Calibration& calibration,
                                      const FitAnalysis& analysis,
                                      const CalibrationProblem& problem);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FIT_ANALYSIS_H_
