#include "core/solver/solver.h"

#include <chrono>

#include <fmt/format.h>
#include <glog/logging.h>

#include "core/solver/levenberg_marquardt.h"
#include "core/solver/truncated_gauss_newton.h"

namespace dhcal {
namespace {

// Gauss-Newton may end a little above a start that was already good (a robust loss, a direction
// that the truncation dropped on the way).
constexpr double kHigherCost = 1.05;

/// Index of a correction beyond its limit (or not a number), or -1.
int FirstBeyondLimit(const Eigen::VectorXd& state, const Eigen::VectorXd& limit) {
  for (Eigen::Index k = 0; k < state.size(); ++k) {
    if (!(std::abs(state[k]) <= limit[k])) return static_cast<int>(k);
  }
  return -1;
}

/// A solver that ended in good order may still have run away.
void CheckForDivergence(const UnknownScales& scales, SolverSummary* summary) {
  if (!summary->IsSolutionUsable()) return;
  const int beyond = FirstBeyondLimit(summary->state, scales.limit);
  if (beyond >= 0) {
    summary->termination = Termination::kDiverged;
    summary->beyond_limit = beyond;
    summary->message =
        fmt::format("Diverged: unknown {} reached {:.3g} (rad or m), beyond its limit of {:g}.",
                    beyond,
                    summary->state[beyond],
                    scales.limit[beyond]);
  } else if (!(summary->final_cost <= kHigherCost * summary->initial_cost + 1e-9)) {
    summary->termination = Termination::kDiverged;
    summary->message = fmt::format("Diverged: the cost rose from {:.6g} to {:.6g}.",
                                   summary->initial_cost,
                                   summary->final_cost);
  }
}

}  // namespace

bool SolverOptions::IsValid(std::string* error) const {
  const auto require = [error](bool holds, const char* field, double value, const char* rule) {
    if (!holds) *error = fmt::format("SolverOptions::{} = {} violates {}", field, value, rule);
    return holds;
  };
  return require(kappa >= 0, "kappa", kappa, "kappa >= 0") &&
         require(max_iterations > 0, "max_iterations", max_iterations, "max_iterations > 0") &&
         require(step_tolerance >= 0, "step_tolerance", step_tolerance, "step_tolerance >= 0") &&
         require(cost_tolerance >= 0, "cost_tolerance", cost_tolerance, "cost_tolerance >= 0") &&
         require(truncation.relative >= 0 && truncation.relative < 1,
                 "truncation.relative",
                 truncation.relative,
                 "0 <= relative < 1");
}

SolverSummary Solver::Solve(const SolverOptions& options, EstimationProblem* problem) const {
  std::string error;
  CHECK(options.IsValid(&error)) << error;
  const auto begin = std::chrono::steady_clock::now();
  SolverSummary summary = DoSolve(options, problem);
  CheckForDivergence(problem->scales, &summary);
  summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return summary;
}

std::unique_ptr<Solver> MakeSolver(SolverMethod method) {
  CHECK(method != SolverMethod::kBoth) << "one solver at a time";
  if (method == SolverMethod::kSvdGaussNewton) return std::make_unique<TruncatedGaussNewton>();
  return std::make_unique<LevenbergMarquardt>();
}

}  // namespace dhcal
