// Levenberg-Marquardt: Ceres' own trust region, reporting through the same callback.
#ifndef DHCAL_CORE_SOLVER_LEVENBERG_MARQUARDT_H_
#define DHCAL_CORE_SOLVER_LEVENBERG_MARQUARDT_H_

#include "core/solver/solver.h"

namespace dhcal {

/// Undetermined directions hardly move: damping takes the place of truncation.
class LevenbergMarquardt final : public Solver {
 protected:
  SolverSummary DoSolve(const SolverOptions& options, EstimationProblem* problem) const override;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_LEVENBERG_MARQUARDT_H_
