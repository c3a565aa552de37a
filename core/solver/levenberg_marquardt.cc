#include "core/solver/levenberg_marquardt.h"

#include <vector>

#include <ceres/manifold.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include "core/solver/trace_callback.h"

namespace dhcal {
namespace {

// Share of the best seen parameter's effect below which a column is rounding.
constexpr double kBlind = 1e-12;

ceres::Solver::Options CeresOptions(const SolverOptions& options) {
  ceres::Solver::Options ceres_options;
  ceres_options.minimizer_type = ceres::TRUST_REGION;
  ceres_options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  ceres_options.linear_solver_type = ceres::DENSE_QR;
  ceres_options.max_num_iterations = options.max_iterations;
  // Weak directions lie six decades below the strong ones: the default tolerances and the default
  // damping would stop before they have moved.
  ceres_options.function_tolerance = 1e-16;
  ceres_options.gradient_tolerance = 1e-18;
  ceres_options.parameter_tolerance = 1e-13;
  ceres_options.initial_trust_region_radius = 1e6;
  ceres_options.update_state_every_iteration = true;
  ceres_options.logging_type = ceres::SILENT;
  return ceres_options;
}

/// Parameters whose column is rounding only. Damping scales with the column, so that such a
/// parameter would be moved at random and far; held constant it stays where it starts.
std::vector<int> BlindParameters(EstimationProblem* problem) {
  Linearization linearization;
  std::vector<int> blind;
  if (!Linearize(problem, &linearization)) return blind;
  const Eigen::VectorXd seen =
      linearization.R.colwise().norm().transpose().cwiseProduct(problem->scales.tolerance);
  for (Eigen::Index k = 0; k < seen.size(); ++k) {
    if (seen[k] <= kBlind * seen.maxCoeff()) blind.push_back(static_cast<int>(k));
  }
  return blind;
}

void Interpret(const SolverOptions& options,
               const ceres::Solver::Summary& ceres_summary,
               const TraceCallback& callback,
               SolverSummary* summary) {
  if (callback.failed() || ceres_summary.termination_type == ceres::FAILURE) {
    summary->termination = Termination::kFailed;
    summary->message = callback.failed() ? "The model cannot be evaluated."
                                         : "Ceres failed: " + ceres_summary.message;
  } else if (callback.kappa_holds()) {
    summary->termination = Termination::kKappa;
    summary->message =
        fmt::format("Kappa test passed: ||J drho - dx|| = {:.4e} m <= kappa = {:.4e} m.",
                    callback.trace().back().kappa_norm,
                    options.kappa);
  } else if (ceres_summary.termination_type == ceres::CONVERGENCE) {
    summary->termination = Termination::kSmallChange;
    summary->message = "Ceres converged: " + ceres_summary.message;
  } else {
    summary->termination = Termination::kIterationLimit;
    summary->message = "Iteration limit: " + ceres_summary.message;
  }
}

}  // namespace

SolverSummary LevenbergMarquardt::DoSolve(const SolverOptions& options,
                                          EstimationProblem* problem) const {
  TraceCallback callback(problem, options.truncation, options.kappa, options.progress);
  const std::vector<int> blind = BlindParameters(problem);
  if (!blind.empty() && static_cast<int>(blind.size()) < problem->num_unknowns()) {
    problem->problem()->SetManifold(problem->block(),
                                    new ceres::SubsetManifold(problem->num_unknowns(), blind));
  }
  ceres::Solver::Options ceres_options = CeresOptions(options);
  ceres_options.callbacks.push_back(&callback);
  ceres::Solver::Summary ceres_summary;
  ceres::Solve(ceres_options, problem->problem(), &ceres_summary);
  problem->problem()->SetManifold(problem->block(), nullptr);

  SolverSummary summary;
  Interpret(options, ceres_summary, callback, &summary);
  summary.state = problem->state();
  summary.initial_cost = ceres_summary.initial_cost;
  summary.final_cost = ceres_summary.final_cost;
  summary.trace = callback.trace();
  summary.svd_of_last_step = callback.svd_of_last_step();
  return summary;
}

}  // namespace dhcal
