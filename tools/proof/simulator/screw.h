// Rigid motions as exponentials of screws (Murray, Li and Sastry 1994, eq. 2.36).
//
// tools/proof/simulator makes recordings whose truth the program is not told. It shares no
// kinematics, no physics and no residuals with what identifies them (tools/check_layers.py holds it
// to that): an error in either would show as a misfit instead of cancelling.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_SCREW_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_SCREW_H_

#include <Eigen/Geometry>

namespace dhcal::concealed {

/// An axis in space: unit direction w, and v = -w x (a point of the axis) [m]. A slide has w = 0
/// and v = its unit direction.
struct Screw {
  Eigen::Vector3d w = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
};

Screw AxisThrough(const Eigen::Vector3d& point, const Eigen::Vector3d& direction);

Screw SlideAlong(const Eigen::Vector3d& direction);

/// Turning by `amount` [rad] about the axis, or sliding by it [m].
Eigen::Isometry3d Exp(const Screw& axis, double amount);

/// A rotation vector [rad] about the origin after a translation [m]; both may be large.
Eigen::Isometry3d Displacement(const Eigen::Vector3d& rotation, const Eigen::Vector3d& translation);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_SCREW_H_
