// A calibrated robot in the URDF that it came from: the file again, its joints' origins corrected.
#ifndef DHCAL_PROBLEMS_FORMATS_URDF_URDF_CORRECTED_H_
#define DHCAL_PROBLEMS_FORMATS_URDF_URDF_CORRECTED_H_

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/diagnostics.h"
#include "core/model/robot.h"
#include "problems/formats/urdf/urdf_chain.h"
#include "problems/formats/urdf/urdf_tree.h"

namespace dhcal {

/// The origin of each moving joint of the chain, parent link to child link at zero.
///
/// A link's frame stays where it is on the physical link. That link is known by its joint's axis:
/// by the frame behind Rz(theta_i) Tz(d_i), which is where modified rows end. So a link's frame
/// keeps its place in that frame; an error of theta_i or d_i turns or shifts the link about its own
/// axis, one of a, alpha or beta moves the next joint's axis in it. All that hangs on a link
/// (meshes, fixed links) moves with it. `calibrated` has the rows of RobotOfUrdf, in any
/// convention, with corrections. Error at `where`: its rows are not those of this chain (another
/// number of joints, another type, corrections above 0.2 m or 0.2 rad).
std::optional<std::vector<Eigen::Isometry3d>> CorrectedOrigins(const UrdfTree& tree,
                                                               const UrdfChain& chain,
                                                               const RobotModel& calibrated,
                                                               const SourceLocation& where,
                                                               Diagnostics* diagnostics);

/// The text of the URDF with the origins of the chain's joints corrected, and the axes of those
/// joints turned round whose sign is -1; every other byte is as it was. A comment before <robot>
/// says what the file cannot hold: `remarks`, and where base and measured point are.
std::optional<std::string> CorrectedUrdf(const UrdfTree& tree,
                                         const UrdfChain& chain,
                                         const RobotModel& calibrated,
                                         const std::vector<std::string>& remarks,
                                         Diagnostics* diagnostics);

/// A comment of XML, or "" of no lines.
std::string XmlComment(const std::vector<std::string>& lines);

/// The attributes xyz [m] and rpy [rad] of a pose, digits enough to read back the same doubles.
std::string XyzRpyAttributes(const Eigen::Isometry3d& X);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_URDF_URDF_CORRECTED_H_
