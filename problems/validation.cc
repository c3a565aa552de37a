#include "problems/validation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/math/row_reduction.h"
#include "core/math/tsqr.h"
#include "core/solver/linearization.h"
#include "core/solver/truncation.h"
#include "problems/assembly.h"
#include "problems/prediction.h"

namespace dhcal {
namespace {

constexpr int kFolds = 5;

/// Triangles of [J, -r], one per block of consecutive readings: all that a left-out prediction
/// needs, whatever the number of rows. Nothing where the model cannot be evaluated.
std::optional<std::vector<Eigen::MatrixXd>> FoldTriangles(const CalibrationProblem& problem) {
  std::vector<RowReduction> folds(kFolds, RowReduction(problem.num_unknowns() + 1));
  const int num_readings = problem.rows().num_readings();
  Eigen::MatrixXd rows;
  const auto visit = [&](const TileRows& tile) {
    // Tiles are of neighbouring readings: those of one fold follow each other.
    const auto count = static_cast<Eigen::Index>(tile.readings.size());
    const Eigen::Index coordinates = tile.rows().rows() / count;
    const auto fold_of = [&](Eigen::Index i) {
      const std::int64_t reading = tile.readings[static_cast<std::size_t>(i)];
      return static_cast<std::size_t>(reading * kFolds / num_readings);
    };
    for (Eigen::Index first = 0, last = 0; first < count; first = last) {
      while (last < count && fold_of(last) == fold_of(first)) ++last;
      for (Eigen::Index c = 0; c < coordinates; ++c) {
        rows.resize(last - first, problem.num_unknowns() + 1);
        rows << tile.J().middleRows(c * count + first, last - first),
            -tile.r().segment(c * count + first, last - first);
        folds[fold_of(first)].Add(rows);
      }
    }
  };
  if (!problem.rows().Visit(problem.state(), problem.row_noise(), visit)) return std::nullopt;
  std::vector<Eigen::MatrixXd> triangles;
  for (RowReduction& fold : folds) triangles.push_back(fold.R());
  return triangles;
}

/// [dx, -1] with the step dx that some rows, given as triangles of [J, -r], ask for.
Eigen::VectorXd StepOf(const std::vector<Eigen::MatrixXd>& triangles,
                       const Eigen::VectorXd& tolerance) {
  Tsqr rows(static_cast<int>(tolerance.size()) + 1);
  for (const Eigen::MatrixXd& triangle : triangles) rows.Add(triangle);
  const Linearization from = FromTriangle(rows.R());
  Eigen::VectorXd step_and_one(tolerance.size() + 1);
  step_and_one << Truncate(Truncation(), tolerance, from).Solve(from.b), -1.0;
  return step_and_one;
}

/// Sums of squares of whitened residuals after the steps of the linear model.
struct FoldSquares {
  double train = 0;  // all folds ask for the step
  double test = 0;   // each fold after the step that the others ask for
};

FoldSquares SquaresOf(const std::vector<Eigen::MatrixXd>& folds,
                      const Eigen::MatrixXd& prior,
                      const Eigen::VectorXd& tolerance) {
  FoldSquares squares;
  std::vector<Eigen::MatrixXd> all = folds;
  all.push_back(prior);
  // The solver may have stopped before its minimum; both figures are of the linear model's.
  const Eigen::VectorXd common = StepOf(all, tolerance);
  for (std::size_t k = 0; k < folds.size(); ++k) {
    std::vector<Eigen::MatrixXd> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    squares.train += (folds[k] * common).squaredNorm();
    squares.test += (folds[k] * StepOf(others, tolerance)).squaredNorm();
  }
  return squares;
}

/// [J, -r] of the priors at the problem's state.
Eigen::MatrixXd PriorRows(const Calibration& c, const Eigen::VectorXd& state) {
  std::vector<Eigen::Index> with_prior;
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    if (c.parameters[k].prior_sigma) with_prior.push_back(static_cast<Eigen::Index>(k));
  }
  Eigen::MatrixXd rows =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(with_prior.size()), state.size() + 1);
  for (std::size_t i = 0; i < with_prior.size(); ++i) {
    const Eigen::Index k = with_prior[i];
    const double sigma = *c.parameters[static_cast<std::size_t>(k)].prior_sigma;
    rows(static_cast<Eigen::Index>(i), k) = 1 / sigma;
    rows(static_cast<Eigen::Index>(i), state.size()) = -state[k] / sigma;
  }
  return rows;
}

}  // namespace

ValidationResult Validate(const Calibration& c,
                          const FitAnalysis& analysis,
                          const CalibrationProblem& problem) {
  const Eigen::VectorXd& state = problem.state();
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
  const int coordinates = c.measurement->kind().num_coordinates();
  const auto num_readings = static_cast<int>(c.readings.fitted.size());
  const int enough = 2 * static_cast<int>(c.parameters.size());
  if (num_readings * coordinates * (kFolds - 1) / kFolds < enough ||
      c.measurement->kind().sees_orientation() || c.recording.sigma.size() > 0 ||
      (c.spec.measurement.noise == NoiseKind::kSharedPose && !c.spec.measurement.anchored)) {
    return result;
  }
  const auto folds = FoldTriangles(problem);
  if (!folds) return result;
  const FoldSquares squares = SquaresOf(*folds, PriorRows(c, state), problem.scales.tolerance);
  const auto rms = [&](double sum) {
    return std::sqrt(sum / (num_readings * coordinates)) * analysis.noise.sigma;
  };
  result.method = "blocked k-fold";
  result.rows = num_readings;
  result.rms_train = rms(squares.train);
  result.rms_test = rms(squares.test);
  if (coordinates == 3) result.rms_point_test = result.rms_test * std::sqrt(3.0);
  return result;
}

}  // namespace dhcal
