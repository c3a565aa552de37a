// Where an elastic arm comes to rest under gravity: joints, links and base yield together, and the
// loads follow the arm as it yields.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_STATICS_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_STATICS_H_

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tools/proof/simulator/arm.h"
#include "tools/proof/simulator/physics.h"

namespace dhcal::concealed {

/// What holds besides the joints' angles at one pose.
struct Circumstances {
  double payload = 0;                  // [kg]
  std::vector<double> growth;          // thermal strain of each link
  Eigen::VectorXd held;                // [rad], slides [m]: error of each joint that no load makes
  std::vector<Eigen::Vector2d> tilts;  // [rad] of each axis; empty = none
};

/// Gravity's torque about each joint [N m], along a slide [N], in the joint's own sense, for links
/// moved by `motions`.
Eigen::VectorXd GravityTorques(const Arm& arm,
                               const ScrewArm& screws,
                               const std::vector<Eigen::Isometry3d>& motions,
                               double payload);

/// The gravity torques of the undeformed arm.
Eigen::VectorXd RigidTorques(const Arm& arm,
                             const ScrewArm& screws,
                             const Eigen::VectorXd& q,
                             double payload);

/// The flange in the base's own frame, times the tilt of the base: at equilibrium.
Eigen::Isometry3d Equilibrium(const Arm& arm,
                              const ScrewArm& screws,
                              const Physics& physics,
                              const Eigen::VectorXd& q,
                              const Circumstances& at);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_STATICS_H_
