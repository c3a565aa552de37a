// Gauss-Newton with a truncated SVD: the nine steps of English et al. (2004).
#ifndef DHCAL_CORE_SOLVER_TRUNCATED_GAUSS_NEWTON_H_
#define DHCAL_CORE_SOLVER_TRUNCATED_GAUSS_NEWTON_H_

#include "core/solver/solver.h"

namespace dhcal {

/// Works on the linearisation that Ceres evaluates. No step control: with a truncation that does
/// not know the noise it runs away, and the summary then says so.
class TruncatedGaussNewton final : public Solver {
 protected:
  void DoSolve(const SolverOptions& options,
               const EstimationProblemFactory& factory,
               EstimationProblem* problem,
               SolverSummary* summary) const override;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_TRUNCATED_GAUSS_NEWTON_H_
