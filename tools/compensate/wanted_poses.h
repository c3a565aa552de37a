// Tables of wanted poses in, of joint commands or predicted poses out.
#ifndef DHCAL_TOOLS_COMPENSATE_WANTED_POSES_H_
#define DHCAL_TOOLS_COMPENSATE_WANTED_POSES_H_

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "tools/compensate/compensate.h"

namespace dhcal {

/// The frame that wanted and predicted poses are in.
enum class PoseFrame { kBase, kWorld };

/// Poses of the table's position and orientation columns as X_WQ; `bases`: X_WB per row. Errors
/// name the first row that lacks one.
std::optional<std::vector<Eigen::Isometry3d>> WantedPoses(
    const Recording& rows,
    const std::vector<Eigen::Isometry3d>& bases,
    PoseFrame frame,
    Diagnostics* diagnostics);

/// Poses that the nominal robot believes it takes at the table's joint coordinates, in its base,
/// brought to W.
std::vector<Eigen::Isometry3d> NominalPoses(const ProblemSpec& nominal,
                                            const Recording& rows,
                                            const std::vector<Eigen::Isometry3d>& bases);

/// The table's joint coordinates where it has them, else `first` for the first row. Nothing, with
/// an error added, where neither says on which branch the arm is.
std::optional<Seeds> SeedsOf(const Recording& rows,
                             const Eigen::VectorXd& first,
                             Diagnostics* diagnostics);

/// `row q1_deg ... position_error_nm rotation_error_nrad [expected_error_mm] status`; refused rows
/// have blank commands. `expected` may be empty.
std::string CommandsToCsv(const RobotModel& robot,
                          const std::vector<Command>& commands,
                          const Eigen::VectorXd& expected);

/// `row x_mm y_mm z_mm qw qx qy qz [expected_error_mm]`.
std::string PosesToCsv(const std::vector<Eigen::Isometry3d>& poses,
                       const Eigen::VectorXd& expected);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_COMPENSATE_WANTED_POSES_H_
