// What the instrument of a random trial reads.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_READINGS_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_READINGS_H_

#include <Eigen/Core>

#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal::concealed {

/// Per row: x y z [m]; of poses w x y z besides; of distances one [m]; of independent differences
/// dx dy dz [m], NaN in the first row of a run. Differences of shared readings: the positions.
Eigen::MatrixXd RandomReadings(const RandomTrial& trial);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_READINGS_H_
