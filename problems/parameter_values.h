// Values of parameters in a robot: what they were, what they have become.
#ifndef DHCAL_PROBLEMS_PARAMETER_VALUES_H_
#define DHCAL_PROBLEMS_PARAMETER_VALUES_H_

#include <Eigen/Core>

#include "core/model/parameter.h"
#include "core/model/robot.h"
#include "problems/calibration.h"
#include "problems/frames.h"

namespace dhcal {

/// The robot of the calibration with a state's corrections: rows, base and tool.
RobotModel CalibratedRobot(const Calibration& calibration, const Eigen::VectorXd& state);

/// Value of a parameter in `robot`, whose frames are `frames`. The rotations of base and tool are
/// components of a rotation vector [rad].
double ValueIn(const RobotModel& robot, const Frames& frames, const Parameter& parameter);

/// What leads from one robot to another: a difference, except that rotations of base and tool are
/// the rotation vector of R_to R_from'.
double Correction(const RobotModel& from,
                  const Frames& frames_from,
                  const RobotModel& to,
                  const Frames& frames_to,
                  const Parameter& parameter);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_PARAMETER_VALUES_H_
