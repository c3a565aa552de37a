// Builds the Ceres problem of a calibration.
#ifndef DHCAL_PROBLEMS_ASSEMBLY_H_
#define DHCAL_PROBLEMS_ASSEMBLY_H_

#include <memory>
#include <vector>

#include "core/model/parameter.h"
#include "core/solver/estimation_problem.h"
#include "problems/calibration.h"

namespace dhcal {

/// Tolerance (a prior's sigma where there is one) and limit of each unknown.
UnknownScales ScalesOf(const std::vector<Parameter>& parameters);

/// The fitted readings, whitened by `noise`, and the priors, at the zero state: one residual block
/// per reading, in order. `calibration` must outlive it.
/// `with_loss`: apply the problem's robust loss.
std::unique_ptr<EstimationProblem> BuildProblem(const Calibration& calibration,
                                                const Noise& noise,
                                                bool with_loss = true);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_ASSEMBLY_H_
