#include "core/kinematics/slots.h"

#include <array>

namespace dhcal {
namespace {

constexpr std::array<const char*, SlotLayout::kPerJoint> kJointNames = {
    "theta", "d", "a", "alpha", "beta"};
constexpr std::array<const char*, SlotLayout::kPerFrame> kFrameNames = {
    "x", "y", "z", "rx", "ry", "rz"};

}  // namespace

std::string SlotLayout::Name(int slot) const {
  if (is_joint(slot)) {
    return kJointNames[static_cast<std::size_t>(slot % kPerJoint)] +
           std::to_string(slot / kPerJoint + 1);
  }
  const bool of_base = is_base(slot);
  const auto component = static_cast<std::size_t>(slot - (of_base ? base(0) : tool(0)));
  return std::string(of_base ? "base_" : "tool_") + kFrameNames[component];
}

bool SlotLayout::is_angle(int slot) const {
  if (is_joint(slot)) {
    const auto kind = static_cast<JointSlot>(slot % kPerJoint);
    return kind != JointSlot::kD && kind != JointSlot::kA;
  }
  return slot - (is_base(slot) ? base(0) : tool(0)) >= 3;
}

}  // namespace dhcal
