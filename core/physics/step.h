// A sudden change at one instant of the recording.
#ifndef DHCAL_CORE_PHYSICS_STEP_H_
#define DHCAL_CORE_PHYSICS_STEP_H_

#include <string>
#include <vector>

#include "core/physics/effect.h"

namespace dhcal {

/// The setting that says when: seconds after the first row (at_s) with a clock, else the number of
/// rows before it (at_row).
const char* StepSetting(const PhysicsContext& context);

/// Why the recording cannot show a step at the request's instant; "" when it can.
std::string StepNotTestable(const PhysicsContext& context, const EffectRequest& request);

/// 0 before the instant, 1 from it on.
Eigen::VectorXd StepProfile(const PhysicsContext& context, const EffectRequest& request);

/// All instants of the recording's clock, ascending, each once.
std::vector<double> Instants(const PhysicsContext& context);

/// Each request at a number of instants, evenly over the rows.
std::vector<EffectRequest> StepCandidates(const PhysicsContext& context,
                                          const std::vector<EffectRequest>& requests);

/// "after 12.5 min", "after row 60".
std::string StepWords(const EffectRequest& request);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_STEP_H_
