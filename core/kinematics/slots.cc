#include "core/kinematics/slots.h"

#include <array>

namespace dhcal {
namespace {

constexpr std::array<const char*, SlotLayout::kPerFrame> kComponentNames = {
    "x", "y", "z", "rx", "ry", "rz"};

}  // namespace

const char* SlotLayout::ComponentName(int component) {
  return kComponentNames[static_cast<std::size_t>(component)];
}

std::string SlotLayout::Name(int slot) const {
  if (is_joint(slot)) {
    return NumberOf(NumberAt(slot)).name + std::to_string(JointOf(slot) + 1);
  }
  const bool of_base = is_base(slot);
  return std::string(of_base ? "base_" : "tool_") +
         ComponentName(slot - (of_base ? base(0) : tool(0)));
}

bool SlotLayout::is_angle(int slot) const {
  if (is_joint(slot)) return NumberOf(NumberAt(slot)).unit == Unit::kRadian;
  return slot - (is_base(slot) ? base(0) : tool(0)) >= 3;
}

}  // namespace dhcal
