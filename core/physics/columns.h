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

/// One parameter per component of a frame, with the same weight: x, y, z [m], and up to 6
/// `components` rx, ry, rz [rad]. `first_slot`: of the frame; `suffix`: of the parameters' names.
std::vector<EffectColumn> FrameColumns(int first_slot,
                                       int components,
                                       double typical,
                                       const Eigen::VectorXd& weight,
                                       const std::string& suffix = "");

/// A parameter that twists all that lies beyond a place (as base slots, core/NOTATION.md).
EffectColumn TwistColumn(const PhysicsContext& context,
                         std::string parameter,
                         std::string unit,
                         double typical,
                         const std::function<Twist(int row_idx)>& twist);

/// Why what moves the base in the measurement frame cannot be told along edges.
constexpr char kFrameOfEdges[] =
    "each edge is a measurement frame of its own, so that the base has no common one to move in";

/// True if turns of the tool about the measured point show in what was recorded.
inline bool TurnsShow(const Recording& recording) {
  return recording.quaternion.rows() > 0 || recording.head.rows() > 0;
}

/// One request per revolute joint (or per joint), without settings.
std::vector<EffectRequest> EveryJoint(const PhysicsContext& context,
                                      const std::string& effect,
                                      bool revolute_only = true);

/// The requests and, where they are testable, the same with a setting at 1.
std::vector<EffectRequest> WithVariant(const Effect& effect,
                                       const PhysicsContext& context,
                                       std::vector<EffectRequest> requests,
                                       const std::string& setting);

/// True when a driver moves so little that it is a constant: it cannot be told from geometry.
bool IsConstant(const Eigen::VectorXd& driver);

/// 0-based index of a request's joint.
inline int JointIndex(const EffectRequest& request) { return request.joint - 1; }

/// Of a context's robot.
inline std::string JointWords(const PhysicsContext& context, int joint_from_1) {
  return dhcal::JointWords(context.robot(), joint_from_1);
}

/// "joint 2", of all robots.
std::string JointName(int joint_from_1);

/// What is wrong with the joint of a request for an effect that needs one; "" when nothing.
std::string CheckJoint(const PhysicsContext& context, const EffectRequest& request);

/// "1.13 +- 0.05 urad per N m": two digits of sigma, in the unit whose size is `unit_size`.
std::string Quantity(const EffectValue& value, double unit_size, const std::string& unit);

/// "0.31 +- 0.02 mrad" of a turning joint, "... mm" of a sliding one, by the value's own unit; of
/// "rad/K" and "m/K" per K.
std::string AmountOfJoint(const EffectValue& value);

/// "x 1.0 +- 0.1 mm, y ...": the first `components` of a frame, turns in mrad.
std::string ComponentsInWords(const std::vector<EffectValue>& values,
                              int components,
                              const std::string& unit_of_lengths = "mm");

/// The value of a parameter of the list; zeros when it is missing.
EffectValue Find(const std::vector<EffectValue>& values, const std::string& parameter);

/// Root of the sum of squares of two parameters (a sine and a cosine), with its sigma.
EffectValue Amplitude(const EffectValue& a, const EffectValue& b);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_COLUMNS_H_
