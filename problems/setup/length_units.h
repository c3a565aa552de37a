// Lengths under the name of another unit: only the ratio of table and readings shows, and which of
// the two is wrong is told by the robot's size.
#ifndef DHCAL_PROBLEMS_SETUP_LENGTH_UNITS_H_
#define DHCAL_PROBLEMS_SETUP_LENGTH_UNITS_H_

#include "core/model/robot.h"

namespace dhcal {

/// `ratio`: lengths of the table over those of the readings, one of the units' ratios. True where
/// the table is wrong, not the readings.
bool TableIsWrong(const RobotModel& robot, double ratio);

/// What the arm would reach by its table [m].
double TableReach(const RobotModel& robot);

/// What lengths hold that are metres when they are multiplied by `factor`.
struct LengthUnitWords {
  const char* holds;    // "metres"
  const char* named;    // ending that the names have: "_mm"
  const char* correct;  // ending that they should have; "" = there is none
};
LengthUnitWords WordsOfLengthUnit(double factor);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_LENGTH_UNITS_H_
