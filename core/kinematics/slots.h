// Slots: the numbers of a chain that anything can perturb (core/NOTATION.md, "Slots").
#ifndef DHCAL_CORE_KINEMATICS_SLOTS_H_
#define DHCAL_CORE_KINEMATICS_SLOTS_H_

#include <string>

#include "core/model/joint_numbers.h"

namespace dhcal {

/// Indices of the slots of a chain of n joints: five per joint, six of the base, six of the tool.
class SlotLayout {
 public:
  static constexpr int kPerJoint = static_cast<int>(kNumJointNumbers);
  static constexpr int kPerFrame = 6;  // x y z [m], rotation vector x y z [rad]

  explicit constexpr SlotLayout(int num_joints) : num_joints_(num_joints) {}

  constexpr int num_joints() const { return num_joints_; }
  constexpr int size() const { return kPerJoint * num_joints_ + 2 * kPerFrame; }

  /// joint_idx counts from 0.
  constexpr int joint(int joint_idx, JointSlot slot) const {
    return kPerJoint * joint_idx + static_cast<int>(slot);
  }
  /// component 0..5.
  constexpr int base(int component) const { return kPerJoint * num_joints_ + component; }
  constexpr int tool(int component) const { return base(kPerFrame) + component; }

  /// The joint (from 0) and the number of its row that a joint slot is.
  static constexpr int JointOf(int slot) { return slot / kPerJoint; }
  static constexpr JointSlot NumberAt(int slot) { return static_cast<JointSlot>(slot % kPerJoint); }

  constexpr bool is_joint(int slot) const { return slot < kPerJoint * num_joints_; }
  constexpr bool is_base(int slot) const { return !is_joint(slot) && slot < tool(0); }

  /// "x", "y", "z", "rx", "ry", "rz" for a frame's components 0..5.
  static const char* ComponentName(int component);
  /// "theta1", "base_x", "tool_rz".
  std::string Name(int slot) const;
  /// True for slots in radians.
  bool is_angle(int slot) const;

 private:
  int num_joints_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_KINEMATICS_SLOTS_H_
