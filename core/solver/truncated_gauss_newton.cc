#include "core/solver/truncated_gauss_newton.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/solver/trace_callback.h"

namespace dhcal {
namespace {

/// How the loop ended; kNotRun = it goes on.
Termination Decide(const SolverOptions& options,
                   const TraceCallback& callback,
                   double previous_cost,
                   std::string* message) {
  const IterationRecord& last = callback.trace().back();
  if (callback.kappa_holds()) {
    *message = fmt::format("Kappa test passed: ||J drho - dx|| = {:.4e} m <= kappa = {:.4e} m.",
                           last.kappa_norm,
                           options.kappa);
    return Termination::kKappa;
  }
  const double change = std::abs(previous_cost - last.cost);
  const double allowed = options.cost_tolerance * (1.0 + last.cost);
  if (last.step_norm <= options.step_tolerance && change <= allowed) {
    *message = fmt::format(
        "Step and cost change are small: step {:.2e} <= {:.2e} tolerances, cost change {:.2e} <= "
        "{:.2e}; ||J drho - dx|| = {:.4e} m stays above kappa = {:.1e} m.",
        last.step_norm,
        options.step_tolerance,
        change,
        allowed,
        last.kappa_norm,
        options.kappa);
    return Termination::kSmallChange;
  }
  if (last.iteration >= options.max_iterations) {
    *message = fmt::format(
        "Iteration limit: {} of {} iterations done; last step {:.2e} tolerances, ||J drho - dx|| = "
        "{:.4e} m.",
        last.iteration,
        options.max_iterations,
        last.step_norm,
        last.kappa_norm);
    return Termination::kIterationLimit;
  }
  return Termination::kNotRun;
}

}  // namespace

void TruncatedGaussNewton::DoSolve(const SolverOptions& options,
                                   const EstimationProblemFactory& /*factory*/,
                                   EstimationProblem* problem,
                                   SolverSummary* summary) const {
  TraceCallback callback(
      problem, &problem->state, options.truncation, options.kappa, options.progress);
  ceres::IterationSummary at;
  at.iteration = 0;
  summary->termination = Termination::kNotRun;
  callback(at);  // steps 1 and 2: predict and linearise at the start
  if (callback.failed()) {
    summary->termination = Termination::kFailed;
    summary->message = "The model cannot be evaluated at the start.";
    summary->state = problem->state_vector();
    return;
  }
  summary->initial_cost = callback.linearization().cost();
  while (summary->termination == Termination::kNotRun) {
    const double previous_cost = callback.linearization().cost();
    problem->set_state(problem->state_vector() + callback.Step());  // steps 3 and 5
    ++at.iteration;
    at.step_is_successful = true;
    at.cost = kNotSet;  // known once the callback has linearised at the new state
    callback(at);       // steps 6 to 8, and the test of step 4 on the step just applied
    if (callback.failed()) {
      summary->termination = Termination::kDiverged;
      summary->message = fmt::format(
          "Diverged: after step {} the model cannot be evaluated any more.", at.iteration);
      break;
    }
    summary->termination = Decide(options, callback, previous_cost, &summary->message);
  }
  summary->state = problem->state_vector();
  summary->trace = callback.trace();
  summary->svd_of_last_step = callback.svd_of_last_step();
  summary->final_cost = callback.failed() ? kNotSet : callback.linearization().cost();
}

}  // namespace dhcal
