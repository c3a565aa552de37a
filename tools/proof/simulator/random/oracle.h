// What of a random trial's causes its readings can show at all: each beside all geometry that may
// be wrong and beside the other causes, in readings of the trial's kind.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_ORACLE_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_ORACLE_H_

#include <Eigen/Core>

#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal::concealed {

/// Fills in the causes' visibility; its RMS are in effective noises of a coordinate. That noise
/// holds, beside the instrument's (or the larger one that the file states), what the joint angles'
/// missing digits do at the pose. Repeats of a pose count as one, outliers as lost; the power is
/// that without the few rows that carry most, which look like outliers.
void WeighCauses(RandomTrial* trial);

/// Effective noise [m], [rad] of every coordinate of `Observe`.
Eigen::VectorXd EffectiveNoise(const RandomTrial& trial);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_ORACLE_H_
