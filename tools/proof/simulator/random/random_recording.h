// The recording of a random trial.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_RECORDING_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_RECORDING_H_

#include <string>

#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal::concealed {

/// Name of a target, of an anchor (from 0): "A", "B" ...
std::string LetterOf(int idx);

std::string RandomRecordingCsv(const RandomTrial& trial);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_RECORDING_H_
