// A random trial as files: what the program gets, and the sealed answer.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_FILES_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_FILES_H_

#include <string>

#include "tools/proof/simulator/case_files.h"
#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal::concealed {

/// The answer holds settings, causes with their visibility, and geometry that is off.
CaseFiles FilesOf(const RandomTrial& trial);

/// "R_00012", of the seed alone: the name of a case is known before it is made.
std::string NameOfRandom(int seed);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_FILES_H_
