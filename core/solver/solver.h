// One interface for the solvers, and what they return.
#ifndef DHCAL_CORE_SOLVER_SOLVER_H_
#define DHCAL_CORE_SOLVER_SOLVER_H_

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/math/truncated_svd.h"
#include "core/model/problem_spec.h"
#include "core/model/result.h"
#include "core/solver/estimation_problem.h"
#include "core/solver/linearization.h"
#include "core/solver/truncation.h"

namespace dhcal {

struct SolverOptions {
  /// Stop when ||J drho - dx|| of a step is at or below this [m] (English et al. 2004, eq. 13).
  /// With noise it never is; zero switches the test off.
  double kappa = 1e-8;
  /// Which singular values count as zero. Levenberg-Marquardt uses it for the report only.
  Truncation truncation;
  int max_iterations = 50;
  /// Stop when a step is shorter than this, in units of the parameters' tolerances, and ...
  double step_tolerance = 1e-6;
  /// ... the cost (1/2 chi-square) changed by no more than this times (1 + cost).
  double cost_tolerance = 1e-9;
  /// Called after each step; may be empty.
  std::function<void(const IterationRecord&)> progress;

  /// False names the field, its value and the rule it breaks.
  bool IsValid(std::string* error) const;
};

struct SolverSummary {
  Termination termination = Termination::kNotRun;
  /// Index of a correction that passed its limit; -1 = none did.
  int beyond_limit = -1;
  std::string message = "The solver was not called.";
  Eigen::VectorXd state;  // corrections to the start
  double initial_cost = kNotSet;
  double final_cost = kNotSet;
  double seconds = kNotSet;
  std::vector<IterationRecord> trace;
  std::optional<TruncatedSvd> svd_of_last_step;

  bool IsSolutionUsable() const {
    return termination == Termination::kKappa || termination == Termination::kSmallChange ||
           termination == Termination::kIterationLimit;
  }
  bool Converged() const {
    return IsSolutionUsable() && termination != Termination::kIterationLimit;
  }
};

/// Non-virtual Solve() checks and times; an algorithm supplies DoSolve().
class Solver {
 public:
  virtual ~Solver() = default;

  /// Solves from the problem's state and leaves it at the solution. A summary that ended in good
  /// order but ran away (a correction beyond its limit, a higher cost) is marked as diverged.
  SolverSummary Solve(const SolverOptions& options, EstimationProblem* problem) const;

 protected:
  virtual SolverSummary DoSolve(const SolverOptions& options, EstimationProblem* problem) const = 0;
};

/// kSvdGaussNewton or kLevenbergMarquardt.
std::unique_ptr<Solver> MakeSolver(SolverMethod method);

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_SOLVER_H_
