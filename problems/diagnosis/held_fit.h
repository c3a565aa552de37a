// The problem file's own parameters, with what the drawing says as evidence: each dimension of a
// row is pulled to its nominal value by its manufacturing tolerance (a prior). Where such a fit
// still needs corrections of many tolerances, the readings say that the file is wrong in another
// way than manufacture is.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_HELD_FIT_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_HELD_FIT_H_

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "problems/calibration.h"
#include "problems/fit.h"

namespace dhcal {

/// A correction of more tolerances than this is no error of manufacture or mastering.
constexpr double kPlausibleTolerances = 10;

/// Not copyable: the calibration refers to spec.
struct HeldFit {
  HeldFit(const ProblemSpec& user_spec, const Recording& recording, const Noise& noise);
  HeldFit(const HeldFit&) = delete;
  HeldFit& operator=(const HeldFit&) = delete;

  ProblemSpec spec;  // the user's, by the noise rule, no robust loss
  Calibration calibration;
  Fit fit;

  const Eigen::VectorXd& state() const { return fit.summary.state; }
  bool usable() const { return fit.summary.IsSolutionUsable(); }
  /// Chi-square of readings and priors together.
  double total() const { return 2 * fit.summary.final_cost; }
};

/// Base and tool are aligned first, where they are estimated; `noise` where the file gives none.
std::unique_ptr<HeldFit> FitHeld(const ProblemSpec& spec,
                                 const Recording& recording,
                                 const Noise& noise);

/// A correction of a row's dimension.
struct RowCorrection {
  Parameter parameter;
  double value = 0;  // [rad or m]
  double tolerance() const { return parameter.prior_sigma.value_or(parameter.tolerance); }
  double tolerances() const { return std::abs(value) / tolerance(); }
};

/// Corrections beyond kPlausibleTolerances, largest first.
std::vector<RowCorrection> ImplausibleCorrections(const HeldFit& fit);

/// Sum of squares of all row corrections in tolerances: what the drawing has against the fit.
double Penalty(const HeldFit& fit);

/// The same question asked of two robots: is any dimension that far from nominal?
bool RowsPlausible(const RobotModel& nominal, const RobotModel& calibrated);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_HELD_FIT_H_
