// Time constants between those of the library's grid: a drift many times above the noise differs
// visibly from its neighbours on any grid, and would lose against a free function of time.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_TIME_CONSTANTS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_TIME_CONSTANTS_H_

#include "core/physics/context.h"
#include "problems/diagnosis/hypotheses/bank.h"

namespace dhcal {

/// Adds to `bank` the best time constant of each of the few drifts that remove most, beside the
/// members that do not drift. `context`: the bank's.
void AddTimeConstants(const PhysicsContext& context, Bank* bank);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_TIME_CONSTANTS_H_
