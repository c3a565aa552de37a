#include "core/physics/driver.h"

#include <fmt/format.h>

namespace dhcal {

std::string DriverWords(const Driver& driver, int own_joint) {
  switch (driver.kind) {
    case DriverKind::kConstant:
      return "constant";
    case DriverKind::kJointAngle:
      return driver.joint == own_joint ? "joint angle"
                                       : fmt::format("angle of joint {}", driver.joint);
    case DriverKind::kJointSpeed:
      return "joint speed";
    case DriverKind::kApproachDirection:
      return "approach direction";
    case DriverKind::kGravityTorque:
      return "gravity torque";
    case DriverKind::kSignOfGravityTorque:
      return "sign of gravity torque";
    case DriverKind::kMeasuredTorque:
      return "measured torque";
    case DriverKind::kOverturningMoment:
      return "overturning moment";
    case DriverKind::kPayload:
      return "payload";
    case DriverKind::kTemperature:
      return "temperature";
    case DriverKind::kTime:
      return "time";
    case DriverKind::kRun:
      return "run";
    case DriverKind::kPosition:
      return "position";
    case DriverKind::kProductOfAngles:
      return "products of joint angles";
    case DriverKind::kColumn:
      return "column";
  }
  return "?";
}

}  // namespace dhcal
