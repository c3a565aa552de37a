#include "core/kinematics/slots.h"

#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dhcal {
namespace {

const std::vector<JointSlot> kKinds = {
    JointSlot::kTheta, JointSlot::kD, JointSlot::kA, JointSlot::kAlpha, JointSlot::kBeta};

TEST(SlotLayout, HasFiveSlotsPerJointAndSixPerFrame) {
  EXPECT_EQ(SlotLayout(6).size(), 42);
  EXPECT_EQ(SlotLayout(1).size(), 17);
}

TEST(SlotLayout, GivesEachSlotOneIndex) {
  for (const int num_joints : {1, 4, 6, 7}) {
    const SlotLayout slots(num_joints);
    std::multiset<int> indices;
    for (int joint = 0; joint < num_joints; ++joint) {
      for (const JointSlot kind : kKinds) indices.insert(slots.joint(joint, kind));
    }
    for (int component = 0; component < 6; ++component) {
      indices.insert(slots.base(component));
      indices.insert(slots.tool(component));
    }
    std::vector<int> all(static_cast<std::size_t>(slots.size()));
    for (int slot = 0; slot < slots.size(); ++slot) all[static_cast<std::size_t>(slot)] = slot;
    EXPECT_THAT(indices, testing::ElementsAreArray(all));
  }
}

TEST(SlotLayout, TellsJointsBaseAndToolApart) {
  const SlotLayout slots(4);
  for (int slot = 0; slot < slots.size(); ++slot) {
    EXPECT_FALSE(slots.is_joint(slot) && slots.is_base(slot)) << slot;
  }
  EXPECT_TRUE(slots.is_joint(slots.joint(3, JointSlot::kBeta)));
  EXPECT_TRUE(slots.is_base(slots.base(0)));
  EXPECT_TRUE(slots.is_base(slots.base(5)));
  EXPECT_FALSE(slots.is_joint(slots.tool(0)) || slots.is_base(slots.tool(0)));
}

TEST(SlotLayout, NamesSlotsAsProblemFilesDo) {
  const SlotLayout slots(6);
  EXPECT_EQ(slots.Name(slots.joint(0, JointSlot::kTheta)), "theta1");
  EXPECT_EQ(slots.Name(slots.joint(1, JointSlot::kD)), "d2");
  EXPECT_EQ(slots.Name(slots.joint(2, JointSlot::kA)), "a3");
  EXPECT_EQ(slots.Name(slots.joint(3, JointSlot::kAlpha)), "alpha4");
  EXPECT_EQ(slots.Name(slots.joint(5, JointSlot::kBeta)), "beta6");
  EXPECT_EQ(slots.Name(slots.base(1)), "base_y");
  EXPECT_EQ(slots.Name(slots.base(3)), "base_rx");
  EXPECT_EQ(slots.Name(slots.tool(2)), "tool_z");
  EXPECT_EQ(slots.Name(slots.tool(5)), "tool_rz");
}

TEST(SlotLayout, NamesNoTwoSlotsAlike) {
  const SlotLayout slots(12);
  std::set<std::string> names;
  for (int slot = 0; slot < slots.size(); ++slot) names.insert(slots.Name(slot));
  EXPECT_EQ(static_cast<int>(names.size()), slots.size());
}

TEST(SlotLayout, CountsTurnsAsAnglesAndShiftsAsLengths) {
  const SlotLayout slots(3);
  for (int slot = 0; slot < slots.size(); ++slot) {
    const std::string name = slots.Name(slot);
    const bool turns = name.find("theta") == 0 || name.find("alpha") == 0 ||
                       name.find("beta") == 0 || name.find("_r") != std::string::npos;
    EXPECT_EQ(slots.is_angle(slot), turns) << name;
  }
}

}  // namespace
}  // namespace dhcal
