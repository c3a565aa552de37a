// The robot and the rows that the effects' worked numbers refer to.
//
// A KUKA KR 15-like arm (standard DH, six revolute joints), each link 10 kg with its centre of mass
// at its frame's origin, nothing carried at row 0. Distances are read to one anchor, A, 1 m below
// the point of row 0.
// Its tool carries a head over straight edges in the plane z = 0 of W: E at rows 0 and 1, F at row
// 2. Lasers stand 10 mm before the camera, 100 mm apart, all look along the tool's z axis (at row 1
// almost along the face: numbers to check by, of no real head).
// Beside it somebody recorded motor_temp: 30, 40, 55.
//   row 0   all joints 0, direction +1, t = 0 s, 20 degC
//   row 1   q = (10, 20, 30, 40, 50, 60) deg, direction +1, t = 3600 s, 30 degC, 0.5 rad/s, 100 N
//   m,
//           5 kg carried
//   row 2   q = -row 1, direction -1, t = 7200 s, 20 degC, -0.5 rad/s, -100 N m, nothing carried,
//           run 2 (the others are of run 1)
#ifndef DHCAL_CORE_PHYSICS_WORKED_EXAMPLE_H_
#define DHCAL_CORE_PHYSICS_WORKED_EXAMPLE_H_

#include "core/model/recording.h"
#include "core/model/robot.h"

namespace dhcal {

RobotModel WorkedExampleRobot();
Recording WorkedExampleRecording();

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_WORKED_EXAMPLE_H_
