// The chain between two links of a URDF, and the robot of Denavit-Hartenberg rows that it is.
#ifndef DHCAL_PROBLEMS_FORMATS_URDF_URDF_CHAIN_H_
#define DHCAL_PROBLEMS_FORMATS_URDF_URDF_CHAIN_H_

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/diagnostics.h"
#include "core/model/robot.h"
#include "problems/formats/urdf/urdf_tree.h"

namespace dhcal {

/// What a user says of a chain: "" = the root; the only link that nothing hangs from.
struct UrdfEnds {
  std::string base_link, tip_link;
  SourceLocation base_where, tip_where;  // for what is wrong with them
};

/// From the base link's frame, A, to the tip link's, E.
struct UrdfChain {
  std::string base_link, tip_link;
  std::vector<std::string> joints;      // those that move
  std::vector<Eigen::Isometry3d> X_AC;  // with all joints at zero: child links of those joints
  Eigen::Isometry3d X_AE = Eigen::Isometry3d::Identity();
};

/// Errors: a link that is not there, a tip that is not below the base, a joint that is none of a
/// serial robot (floating, planar, one that follows another), no joint that moves.
std::optional<UrdfChain> FindUrdfChain(const UrdfTree& tree,
                                       const UrdfEnds& ends,
                                       Diagnostics* diagnostics);

/// The chain as a robot whose joints count as the URDF's do (sign 1). X_WB is X_AB and X_TQ is
/// X_TE; gravity points along -z of A. Masses are those of all links that a joint carries, up to
/// the next joint of the chain; what moves beside the chain (fingers) counts where it stands at
/// zero, and a note says so.
RobotModel RobotOfUrdf(const UrdfTree& tree, const UrdfChain& chain, Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_URDF_URDF_CHAIN_H_
