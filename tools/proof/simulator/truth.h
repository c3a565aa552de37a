// The true positions of the tool point: every mechanism in the order in which it acts.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_TRUTH_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_TRUTH_H_

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tools/proof/simulator/arm.h"
#include "tools/proof/simulator/motion.h"
#include "tools/proof/simulator/physics.h"

namespace dhcal::concealed {

/// The measured point's frame in the measurement frame. The poses are taken in their order: play
/// and friction remember where the joints came from; a new run forgets.
std::vector<Eigen::Isometry3d> TruePoses(const Arm& built,
                                         const Physics& physics,
                                         const Motion& motion);

/// Its positions [m] (poses x 3).
Eigen::MatrixXd TruePositions(const Arm& built, const Physics& physics, const Motion& motion);

/// What the instrument's unit of length makes of every length that it reads at a time.
double ScaleOf(const Instrument& instrument, double time);

/// [rad] what friction and play add to each joint (poses x joints).
Eigen::MatrixXd LostMotion(const Arm& built, const Physics& physics, const Motion& motion);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_TRUTH_H_
