// Straight paths of the tool through inverse kinematics: what English et al. (2004) announce as
// "a new simulation imposing linear robot motions".
#ifndef DHCAL_PROBLEMS_LINE_MOTION_H_
#define DHCAL_PROBLEMS_LINE_MOTION_H_

#include <optional>

#include <Eigen/Core>

#include "core/base/diagnostics.h"
#include "core/base/rng.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"

namespace dhcal {

/// Rotation by a vector whose components are up to `most` [rad], any alike.
Eigen::Matrix3d RandomTilt(double most, Rng* rng);

/// Joint coordinates at which the nominal robot stands along the lines of `simulate.motion`, evenly
/// spaced and tilted at random, each line a run of its own or one of its edge. Nothing, with an
/// error added that says which pose and why, where the robot cannot go.
std::optional<Recording> LineMotion(const ProblemSpec& spec, Rng* rng, Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_LINE_MOTION_H_
