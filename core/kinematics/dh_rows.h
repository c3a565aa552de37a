// Denavit-Hartenberg rows for joint axes that lie anywhere, and one convention's rows for
// another's. Rows: core/NOTATION.md.
#ifndef DHCAL_CORE_KINEMATICS_DH_ROWS_H_
#define DHCAL_CORE_KINEMATICS_DH_ROWS_H_

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/model/robot.h"

namespace dhcal {

/// A joint's axis with all joints at zero: a line in some fixed frame A.
struct JointAxis {
  JointType type = JointType::kRevolute;
  Eigen::Vector3d p_A = Eigen::Vector3d::Zero();   // [m] a point of it
  Eigen::Vector3d z_A = Eigen::Vector3d::UnitZ();  // unit vector, in the sense of its coordinate
};

/// Rows with the numbers alone (names and limits are the caller's), and what no row can hold.
struct RowsOfAxes {
  std::vector<JointRow> rows;                              // standard
  Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();  // to the base, L_0
  Eigen::Isometry3d X_TE = Eigen::Isometry3d::Identity();  // from the flange, L_n
};

/// Axes closer to parallel than this have their row in Hayati's form, d = 0 and an angle beta:
/// their common normal may be kilometres away. sin of the angle.
constexpr double kNearlyParallel = 1e-2;

/// Standard rows whose chain X_AB A_1 ... A_n X_TE moves the frame E about these axes, all of them
/// with sign 1, to rounding. `X_AE` is where E stands at zero. Of the turns by 180 deg that DH
/// leaves open, each row takes the one of the smaller theta. B is the point of the first axis next
/// to A's origin; the last row reaches towards E's z axis, so that E = T where the maker's tables
/// have it. Rounding leaves no traces: a right angle is one.
RowsOfAxes StandardRows(const std::vector<JointAxis>& axes, const Eigen::Isometry3d& X_AE);

/// Starts the chain at `X_before` and ends it with `X_behind`: base and tool, gravity and payload
/// follow, for the robot as a whole stays where it is.
void FoldIntoEnds(const Eigen::Isometry3d& X_before,
                  const Eigen::Isometry3d& X_behind,
                  RobotModel* robot);

/// The same robot in the rows of a convention: the factors are grouped anew, no number changes.
/// What is left at an end becomes part of base or tool; masses keep their places.
RobotModel InConvention(const RobotModel& robot, DhConvention convention);

/// The same robot with rows of nearly parallel axes in Hayati's form, where they were not: common
/// normals hundreds of metres away, as makers' calibrations have them, cost digits and are no start
/// of a fit. Masses are taken as given for the new frames.
RobotModel WithNearNormals(const RobotModel& robot);

}  // namespace dhcal

#endif  // DHCAL_CORE_KINEMATICS_DH_ROWS_H_
