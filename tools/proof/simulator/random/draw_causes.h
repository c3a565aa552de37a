// Which causes a random trial has, where, and how strong.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_DRAW_CAUSES_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_DRAW_CAUSES_H_

#include "core/base/rng.h"
#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal::concealed {

/// None in a fifth of the trials, else one to three that differ in effect or joint, each 0.5 to 30
/// usual sizes. Only causes that the trial's arm and file can have are drawn: a reading that is
/// late needs speeds, a sag a load. Sets `settings.directions` and `settings.clock` where a cause
/// needs the column.
void DrawCauses(RandomTrial* trial, Rng* rng);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_DRAW_CAUSES_H_
