// Building blocks of effects: columns on a joint, on all that lies beyond a place, on a frame.
#ifndef DHCAL_CORE_PHYSICS_COLUMNS_H_
#define DHCAL_CORE_PHYSICS_COLUMNS_H_

#include <functional>
#include <string>
#include <vector>

#include "core/physics/effect.h"

namespace dhcal {

/// A parameter that acts on one slot.
EffectColumn SlotColumn(
    std::string parameter, std::string unit, double typical, int slot, Eigen::VectorXd weight);

/// A parameter that twists all that lies beyond a place (as base slots, core/NOTATION.md).
EffectColumn TwistColumn(const PhysicsContext& context,
                         std::string parameter,
                         std::string unit,
                         double typical,
                         const std::function<Twist(int row_idx)>& twist);

/// The requests and, where they are testable, the same with a setting at 1.
std::vector<EffectRequest> WithVariant(const Effect& effect,
                                       const PhysicsContext& context,
                                       std::vector<EffectRequest> requests,
                                       const std::string& setting);

/// True when a driver moves so little that it is a constant: it cannot be told from geometry.
bool IsConstant(const Eigen::VectorXd& driver);

/// 0-based index of a request's joint.
inline int JointIndex(const EffectRequest& request) { return request.joint - 1; }

/// "joint 2", "joints 4 and 5".
std::string JointName(int joint_from_1);

/// "1.13 +- 0.05 urad per N m": two digits of sigma, in the unit whose size is `unit_size`.
std::string Quantity(const EffectValue& value, double unit_size, const std::string& unit);

/// The value of a parameter of the list; zeros when it is missing.
EffectValue Find(const std::vector<EffectValue>& values, const std::string& parameter);

/// Root of the sum of squares of two parameters (a sine and a cosine), with its sigma.
EffectValue Amplitude(const EffectValue& a, const EffectValue& b);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_COLUMNS_H_
