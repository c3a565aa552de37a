// What is planned for: the unknowns that all poses share, the region, and the noise.
#ifndef DHCAL_PROBLEMS_PLAN_PLAN_SPACE_H_
#define DHCAL_PROBLEMS_PLAN_PLAN_SPACE_H_

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/task.h"
#include "problems/calibration.h"
#include "problems/plan/candidates.h"

namespace dhcal {

/// The problem as a plan sees it: one run, no effects that need more than the pose, pairs of
/// positions read as the positions themselves (which with their shared noise they amount to, but
/// for a shift that nobody knows). Notes say what was changed.
ProblemSpec PlanningProblem(const ProblemSpec& spec, std::vector<std::string>* notes);

/// Names of the unknowns that are the same for all rows.
std::vector<std::string> SharedNames(const Calibration& calibration);

/// The mean over the region of J'J, columns in tolerances and in the order of `names`: trace(W C)
/// is the mean square of the error.
Eigen::MatrixXd RegionWeights(const Calibration& calibration,
                              const std::vector<std::string>& names,
                              const TaskError& region);

/// The region of the task, or without one the robot's whole range.
TaskError PlanRegion(const ProblemSpec& spec);

/// Given noise, or what the user's own readings show. `fit_rms` (3-D [m]) is what they leave, NaN
/// without them. Nothing, with an error added, where nobody knows.
std::optional<Noise> PlanNoise(const ProblemSpec& spec,
                               const Recording* own,
                               double* fit_rms,
                               Diagnostics* diagnostics);

/// The candidates' rows with readings as the planning problem has them.
std::optional<Recording> ReadingsAt(const ProblemSpec& planning,
                                    const Recording& rows,
                                    Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_PLAN_PLAN_SPACE_H_
