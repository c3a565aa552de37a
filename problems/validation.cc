#include "problems/validation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/tsqr.h"
#include "core/solver/linearization.h"
#include "core/solver/truncation.h"
#include "problems/assembly.h"
#include "problems/prediction.h"

namespace dhcal {
namespace {

constexpr int kFolds = 5;

/// Triangles of [J, -r], one per block of consecutive readings: all that a left-out prediction
/// needs, whatever the number of rows.
std::vector<Eigen::MatrixXd> FoldTriangles(EstimationProblem* problem, int coordinates) {
  const int num_unknowns = problem->num_unknowns();
  std::vector<Tsqr> folds(kFolds, Tsqr(num_unknowns + 1));
  const auto num_readings = static_cast<Eigen::Index>(problem->readings.size());
  ForEachChunk(problem,
               problem->readings,
               [&](int first, const Eigen::VectorXd& r, const Eigen::MatrixXd& J) {
                 Eigen::MatrixXd rows(J.rows(), num_unknowns + 1);
                 rows << J, -r;
                 for (Eigen::Index k = 0; k < rows.rows(); k += coordinates) {
                   const Eigen::Index reading = first + k / coordinates;
                   const auto fold = static_cast<std::size_t>(reading * kFolds / num_readings);
                   folds[fold].Add(rows.middleRows(k, coordinates));
                 }
               });
  std::vector<Eigen::MatrixXd> triangles;
  for (Tsqr& fold : folds) triangles.push_back(fold.R());
  return triangles;
}

/// Sum of squares of one fold's whitened residuals after the step that the other folds ask for, or
/// that all folds ask for.
double SquaresAfterStep(const std::vector<Eigen::MatrixXd>& folds,
                        std::size_t of,
                        bool leave_out,
                        const Eigen::MatrixXd& prior,
                        const Eigen::VectorXd& tolerance) {
  Tsqr others(static_cast<int>(tolerance.size()) + 1);
  for (std::size_t k = 0; k < folds.size(); ++k) {
    if (k != of || !leave_out) others.Add(folds[k]);
  }
  others.Add(prior);
  const Linearization from = FromTriangle(others.R(), others.num_rows());
  const Eigen::VectorXd step = Truncate(Truncation(), tolerance, from).Solve(from.b);
  Eigen::VectorXd step_and_one(step.size() + 1);
  step_and_one << step, 1.0;
  // [J, -r] (dx, 1) with the sign of -r turned: J dx + r = -( [J, -r] (-dx, 1) ).
  step_and_one.head(step.size()) *= -1;
  return (folds[of] * step_and_one).squaredNorm();
}

Eigen::MatrixXd PriorRows(EstimationProblem* problem) {
  Tsqr tsqr(problem->num_unknowns() + 1);
  ForEachChunk(problem,
               problem->priors,
               [&](int /*first*/, const Eigen::VectorXd& r, const Eigen::MatrixXd& J) {
                 Eigen::MatrixXd rows(J.rows(), J.cols() + 1);
                 rows << J, -r;
                 tsqr.Add(rows);
               });
  return tsqr.R();
}

}  // namespace

ValidationResult Validate(const Calibration& c,
                          const FitAnalysis& analysis,
                          const Eigen::VectorXd& state) {
  ValidationResult result;
  result.noise_sigma = analysis.noise.sigma;
  result.rms_train = Statistics(c, state, c.readings.fitted).rms;
  if (!c.readings.test.empty()) {
    const ResidualStatistics unseen = Statistics(c, state, c.readings.test);
    result.method = "set column";
    result.rows = static_cast<int>(c.readings.test.size());
    result.rms_test = unseen.rms;
    result.rms_point_test = unseen.rms_point;
    result.max_point_test = unseen.max_point;
    return result;
  }
  // With few readings the folds determine less than the whole; with mixed units, rows of different
  // weight or whitened contrasts one number in metres would not describe them.
  const int coordinates = NumCoordinates(c.spec.measurement.kind);
  const auto num_readings = static_cast<int>(c.readings.fitted.size());
  const int enough = 2 * static_cast<int>(c.parameters.size());
  if (num_readings * coordinates * (kFolds - 1) / kFolds < enough ||
      c.spec.measurement.kind == MeasurementKind::kPose || c.recording.sigma.size() > 0 ||
      c.spec.measurement.noise == NoiseKind::kSharedPose) {
    return result;
  }
  const auto problem = BuildProblem(c, analysis.noise, /*with_loss=*/false);
  problem->set_state(state);
  const std::vector<Eigen::MatrixXd> folds = FoldTriangles(problem.get(), coordinates);
  const Eigen::MatrixXd prior = PriorRows(problem.get());
  double train = 0, test = 0;
  for (std::size_t k = 0; k < folds.size(); ++k) {
    // The solver may have stopped before its minimum; both figures are of the linear model's.
    train += SquaresAfterStep(folds, k, false, prior, problem->scales.tolerance);
    test += SquaresAfterStep(folds, k, true, prior, problem->scales.tolerance);
  }
  const auto rms = [&](double squares) {
    return std::sqrt(squares / (num_readings * coordinates)) * analysis.noise.sigma;
  };
  result.method = "blocked k-fold";
  result.rows = num_readings;
  result.rms_train = rms(train);
  result.rms_test = rms(test);
  if (coordinates == 3) result.rms_point_test = result.rms_test * std::sqrt(3.0);
  return result;
}

}  // namespace dhcal
