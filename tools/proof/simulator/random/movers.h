// What could move the measured point, freedom by freedom, and what a trial's readings see of it.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_MOVERS_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_MOVERS_H_

#include <functional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal::concealed {

struct World {
  Arm arm;
  Physics physics;
};
using Mover = std::function<void(World*, double)>;

constexpr double kStepOfGeometry = 1e-5;  // [rad] or [m], of central differences
constexpr double kStepOfMass = 0.01;      // [kg], [m] of the centre

/// All rows, tilts of axes that are drawn parallel, base, tool, targets, stated setups.
std::vector<Mover> GeometryMovers(const RandomTrial& trial);

/// Coordinates of the joints.
std::vector<Mover> JointMovers(const Arm& arm);

/// Masses and centres of the links.
std::vector<Mover> MassMovers(const Arm& arm);

/// Observe() of a world.
Eigen::VectorXd Seen(const RandomTrial& trial,
                     const World& world,
                     const std::vector<Eigen::Isometry3d>& reference);

/// Derivatives of all coordinates of Observe() by central differences.
Eigen::MatrixXd Derivatives(const RandomTrial& trial,
                            const World& world,
                            const std::vector<Mover>& movers,
                            double step);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_MOVERS_H_
