// The course of a slow change: with temperature, or with time towards a limit.
#ifndef DHCAL_CORE_PHYSICS_DRIFT_H_
#define DHCAL_CORE_PHYSICS_DRIFT_H_

#include <string>
#include <vector>

#include "core/physics/effect.h"

namespace dhcal {

/// True if a request goes by the clock (setting time_constant_s, or no temperature column).
bool DriftByTime(const PhysicsContext& context, const EffectRequest& request);

/// The setting that makes it go by the clock.
EffectSetting TimeConstantSetting();

/// What drives a request's course.
Driver DriftDriver(const PhysicsContext& context, const EffectRequest& request);

/// Why the recording cannot show it; `joint` (from 0) chooses the temperature column.
std::string DriftNotTestable(const PhysicsContext& context,
                             const EffectRequest& request,
                             int joint);

/// T - T(first row) [K]; or 1 - exp(-t/T) by the clock of the run, or t / duration where the time
/// constant is 0 or not given.
Eigen::VectorXd DriftProfile(const PhysicsContext& context,
                             const EffectRequest& request,
                             int joint);

/// Each request with the temperature (where recorded) and with a range of time constants.
std::vector<EffectRequest> DriftCandidates(const PhysicsContext& context,
                                           const std::vector<EffectRequest>& requests);

/// " with a time constant of 42 min", " steadily", "".
std::string DriftWords(const EffectRequest& request);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_DRIFT_H_
