// The error that a calibration lets expect where accuracy matters.
#ifndef DHCAL_PROBLEMS_TASK_TASK_ERROR_H_
#define DHCAL_PROBLEMS_TASK_TASK_ERROR_H_

#include <Eigen/Core>

#include "core/analysis/identifiability.h"
#include "core/model/problem_spec.h"
#include "core/model/task.h"
#include "problems/calibration.h"

namespace dhcal {

/// The poses that stand for a task: the user's own, or drawn in its box; the region in words, or
/// why there are none.
TaskError TaskPoses(const ProblemSpec& spec);

/// RMS of J dx over points (J: 3 points x parameters) with dx normal of this covariance: its
/// expectation's root, and where 95 % of draws lie (by the first two moments of the mean square,
/// Satterthwaite 1946).
RegionError ExpectedError(const Eigen::MatrixXd& J, const Eigen::MatrixXd& covariance);

/// Errors before and after of a fit that ended at `state`. `task` has poses, and where the nominal
/// robot is at them unless this calibration's own start is the nominal robot.
void FillTaskError(const Calibration& calibration,
                   const Identifiability& identifiability,
                   const Eigen::VectorXd& state,
                   TaskError* task);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_TASK_TASK_ERROR_H_
