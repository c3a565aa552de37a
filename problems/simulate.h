// Makes a recording from a robot with known errors.
#ifndef DHCAL_PROBLEMS_SIMULATE_H_
#define DHCAL_PROBLEMS_SIMULATE_H_

#include <optional>

#include <Eigen/Core>

#include "core/base/diagnostics.h"
#include "core/base/rng.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"

namespace dhcal {

/// The errors of `simulation` as slot perturbations (core/kinematics/slots.h).
Eigen::VectorXd ErrorSlots(const RobotModel& robot, const SimulationSpec& simulation);

/// The recording that `spec.simulate` describes: nominal robot plus errors plus noise, in the
/// columns that the measurement kind reads. Each pose is measured on every target; distances take
/// the anchors in turn. Nothing, with an error added, when a motion file cannot be read.
std::optional<Recording> SimulateRecording(const ProblemSpec& spec, Diagnostics* diagnostics);

/// The same at poses that are given: `motion` has joint coordinates and labels, and what effects
/// need beside them.
std::optional<Recording> SimulateAt(const ProblemSpec& spec,
                                    const Recording& motion,
                                    Rng* rng,
                                    Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SIMULATE_H_
