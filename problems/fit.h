// Runs one solver on a calibration, with noise that may have to be found on the way.
#ifndef DHCAL_PROBLEMS_FIT_H_
#define DHCAL_PROBLEMS_FIT_H_

#include <memory>
#include <string>

#include "core/model/problem_spec.h"
#include "core/solver/solver.h"
#include "problems/assembly.h"
#include "problems/calibration.h"
#include "problems/progress.h"

namespace dhcal {

struct Fit {
  SolverMethod method = SolverMethod::kSvdGaussNewton;
  SolverSummary summary;
  Noise noise;       // that whitened the last solve
  Noise noise_seen;  // given, or what the residuals at the solution show
  /// False where the two still differ after as many rounds as there may be.
  bool noise_settled = false;
  std::shared_ptr<CalibrationProblem> problem;  // at the solution; what was solved
};

/// Solver options as the problem file sets them.
SolverOptions OptionsOf(const SolverSpec& spec);

/// How a calibration is solved.
struct FitSettings {
  SolverMethod method = SolverMethod::kSvdGaussNewton;
  SolverOptions solver;
  Noise noise;            // that whitens the first solve
  Progress progress;      // may be empty
  Eigen::VectorXd start;  // a state near the solution; empty = the calibration's own start
};

/// SVD-Gauss-Newton as the problem file sets it, from the noise that is known before any fit.
FitSettings SettingsOf(const Calibration& calibration, const Progress& progress = {});

/// Solves. Where the noise is to be estimated and the solution depends on it (noise rule, robust
/// loss, two kinds of reading), solves again from the start until the noise that the residuals show
/// agrees with the one assumed to 1 %.
Fit RunFit(const Calibration& calibration, const FitSettings& settings);

/// The same for a calibration with effects: they load the arm that the fit finds, so it is fitted
/// again on that arm, and the calibration keeps it. Without effects RunFit alone. The arm of a
/// start that is given is good enough.
Fit RunBentFit(const FitSettings& settings, Calibration* calibration);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FIT_H_
