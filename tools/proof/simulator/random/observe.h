// What of the measured frames a kind of reading sees.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_OBSERVE_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_OBSERVE_H_

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal::concealed {

/// Coordinates that a row gives: 3 of a position or of a difference, 6 of a pose, 1 of a distance.
int CoordinatesPerRow(Kind kind);

/// All rows' coordinates, one below the other: positions [m], rotations from `reference` [rad],
/// distances, as the instrument reads them without noise. Differences of shared readings are left
/// as positions: they see these but for a constant of the run (`oracle.cc`); a row without one
/// before is zero.
Eigen::VectorXd Observe(const RandomTrial& trial,
                        const std::vector<Eigen::Isometry3d>& poses,
                        const std::vector<Eigen::Isometry3d>& reference,
                        const Instrument& instrument);

/// [m] from the row's anchor to a point, as the instrument reads it without noise.
double DistanceRead(const RandomTrial& trial,
                    std::size_t row,
                    const Eigen::Vector3d& p,
                    const Instrument& instrument);

/// Rotation vector [rad] of a rotation by less than half a turn.
Eigen::Vector3d RotationVector(const Eigen::Matrix3d& R);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_OBSERVE_H_
