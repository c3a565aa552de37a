// Where a random trial's arm was sent.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_POSES_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_POSES_H_

#include <vector>

#include <Eigen/Core>

#include "core/base/rng.h"
#include "tools/proof/simulator/motion.h"
#include "tools/proof/simulator/random/settings.h"

namespace dhcal::concealed {

/// The angles are those that the arm reaches; the file rounds them.
Motion DrawMotion(const Settings& settings, const Arm& arm, Rng* rng);

/// What one digit of the joint angles in the file is worth [rad], slides [m].
Eigen::VectorXd ReadOutQuanta(const Settings& settings, const Arm& arm);

/// Directions of the joints' last motion, poses x joints; at the start of a run as they come.
Eigen::MatrixXi Directions(const Motion& motion);

/// The row before of the same run and target, or -1.
std::vector<int> RowsBefore(const Motion& motion);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_POSES_H_
