// What drives an effect, or an unexplained rest: a quantity of the pose or of the recording.
#ifndef DHCAL_CORE_PHYSICS_DRIVER_H_
#define DHCAL_CORE_PHYSICS_DRIVER_H_

#include <string>

namespace dhcal {

enum class DriverKind {
  kConstant,
  kJointAngle,  // of a prismatic joint its travel
  kJointSpeed,
  kApproachDirection,
  kGravityTorque,
  kSignOfGravityTorque,
  kMeasuredTorque,
  kOverturningMoment,
  kPayload,
  kTemperature,
  kTime,
  kRun,
  kPosition,  // of the measured point
  kProductOfAngles,
  kColumn  // of the recording that the program has no name for
};

struct Driver {
  DriverKind kind = DriverKind::kConstant;
  int joint = 0;  // whose it is, from 1; 0 = no joint's

  bool is_torque() const {
    return kind == DriverKind::kGravityTorque || kind == DriverKind::kMeasuredTorque;
  }
  bool operator==(const Driver& other) const { return kind == other.kind && joint == other.joint; }
};

/// "gravity torque"; a joint's angle is "joint angle" where that joint is `own_joint`, else "angle
/// of joint 4".
std::string DriverWords(const Driver& driver, int own_joint);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_DRIVER_H_
