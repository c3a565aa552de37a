// Gauss-Newton with a truncated SVD: the nine steps of English et al. (2004).
#ifndef DHCAL_CORE_SOLVER_TRUNCATED_GAUSS_NEWTON_H_
#define DHCAL_CORE_SOLVER_TRUNCATED_GAUSS_NEWTON_H_

#include "core/solver/solver.h"

namespace dhcal {

/// Under the rules that know tolerances (noise, relative) ceres::Solve takes each step, in the
/// subspace that the truncation keeps at the state (core/solver/truncated_subspace.h): with next to
/// no damping, so that it is the truncated Gauss-Newton step, and with more where that step would
/// raise the cost. The paper's rule takes the paper's step without any control: with a truncation
/// that does not know the noise it runs away, and the summary then says so.
class TruncatedGaussNewton final : public Solver {
 protected:
  SolverSummary DoSolve(const SolverOptions& options, EstimationProblem* problem) const override;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_TRUNCATED_GAUSS_NEWTON_H_
