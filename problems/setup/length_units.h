// Lengths under the name of another unit: only the ratio of table and readings shows, and which of
// the two is wrong is told by the robot's size.
#ifndef DHCAL_PROBLEMS_SETUP_LENGTH_UNITS_H_
#define DHCAL_PROBLEMS_SETUP_LENGTH_UNITS_H_

#include <optional>

#include "core/model/robot.h"

namespace dhcal {

/// What makes metres of the table's and of the readings' lengths.
struct LengthFactors {
  double table = 1, readings = 1;
};
/// `ratio`: lengths of the table over those of the readings, as base and tool find it. The units
/// whose ratio is near it and with which the arm has a size that arms have; factors of 1 where
/// there are none.
std::optional<LengthFactors> UnitsOf(const RobotModel& robot, double ratio);

/// What makes metres of the lengths of the file's tool, if the readings have it at `p_TQ` [m]: 1
/// unless the two are a thousand times apart in one direction.
double ToolScale(const RobotModel& robot, const Eigen::Vector3d& p_TQ);

/// What the arm would reach by its table [m].
double TableReach(const RobotModel& robot);
/// The same within the sizes that arms have: what misfits are held against.
double ReachOf(const RobotModel& robot);

/// What lengths hold that are metres when they are multiplied by `factor`.
struct LengthUnitWords {
  const char* holds;    // "metres"
  const char* named;    // ending that the names have: "_mm"
  const char* correct;  // ending that they should have; "" = there is none
};
LengthUnitWords WordsOfLengthUnit(double factor);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_LENGTH_UNITS_H_
