// What descriptions tell the rest of the program, so that it need not know effects by name.
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/physics/registry.h"

namespace dhcal {
namespace {

const EffectSetting& Setting(const std::string& effect, const std::string& setting) {
  const EffectSetting* const found = FindEffect(effect)->FindSetting(setting);
  EXPECT_NE(found, nullptr) << effect << " " << setting;
  return *found;
}

TEST(EffectSettings, CountsAreWholeNumbersAndSwitchesOneOrZero) {
  const auto high = [](const std::string& effect, const std::string& setting) {
    const auto range = WholeRangeOf(Setting(effect, setting), 6);
    return range ? range->high : -1;
  };
  EXPECT_EQ(high("joint_coupling", "driver_joint"), 6);
  EXPECT_EQ(high("backlash", "flank"), 1);
  EXPECT_EQ(high("joint_compliance", "measured_torque"), 1);
  EXPECT_EQ(high("joint_compliance", "free_masses"), 1);
  EXPECT_EQ(high("tool_step", "at_row"), 10000000);
  EXPECT_EQ(high("gear_harmonic", "order"), -1);
  EXPECT_EQ(high("base_drift", "time_constant_s"), -1);
  EXPECT_EQ(high("joint_step", "at_s"), -1);
  EXPECT_EQ(high("torsion_nonlinearity", "soft_torque_Nm"), -1);
  EXPECT_EQ(FindEffect("joint_gain")->FindSetting("order"), nullptr);
}

TEST(EffectSettings, AreRefinedWhereTheirValuesArePointsOfOneScan) {
  EXPECT_TRUE(Setting("joint_step", "at_s").is_refined());
  EXPECT_TRUE(Setting("joint_step", "at_row").is_refined());
  EXPECT_TRUE(Setting("link_thermal", "time_constant_s").is_refined());
  EXPECT_TRUE(Setting("torsion_nonlinearity", "soft_torque_Nm").is_refined());
  EXPECT_FALSE(Setting("gear_harmonic", "order").is_refined()) << "each order is a line of its own";
  EXPECT_FALSE(Setting("axis_wobble", "order").is_refined());
  EXPECT_FALSE(Setting("joint_coupling", "driver_joint").is_refined());
}

TEST(Line, IsARequestOfTheOrderThatItIsAskedFor) {
  const EffectRequest line = Line(3, 12.5);
  EXPECT_EQ(line.effect, "gear_harmonic");
  EXPECT_EQ(line.joint, 3);
  EXPECT_EQ(LineEffect().Order(line), 12.5);
  EXPECT_EQ(LineEffect().Order(LineEffect().Request(3)), 1) << "the default";
  EXPECT_EQ(FindEffect("joint_gain")->Order(FindEffect("joint_gain")->Request(3)), 1);
}

TEST(EffectThatCompletes, IsThatOfEachGroupThatAFileMayLeaveOut) {
  EXPECT_EQ(EffectThatCompletes(ParameterGroup::kBeta), FindEffect("axis_tilt"));
  EXPECT_EQ(EffectThatCompletes(ParameterGroup::kBase), FindEffect("base_frame"));
  EXPECT_EQ(EffectThatCompletes(ParameterGroup::kTool), FindEffect("tool_offset"));
  EXPECT_EQ(EffectThatCompletes(ParameterGroup::kTheta), nullptr);
  EXPECT_EQ(EffectThatCompletes(ParameterGroup::kEffect), nullptr);
}

TEST(FindEffect, IsTheEntryOfTheListWithThatName) {
  for (const Effect* const effect : AllEffects()) {
    EXPECT_EQ(FindEffect(effect->name()), effect);
    EXPECT_EQ(effect->Request(2).effect, effect->name());
  }
}

TEST(EffectClass, NamesAreUniqueAndEachHasItsAdvice) {
  std::set<std::string> names;
  for (int k = 0; k <= static_cast<int>(EffectClass::kGeometry); ++k) {
    const auto effect_class = static_cast<EffectClass>(k);
    EXPECT_TRUE(names.insert(ToString(effect_class)).second) << ToString(effect_class);
    EXPECT_FALSE(std::string(Advice(effect_class)).empty());
  }
  EXPECT_STREQ(ToString(EffectClass::kShoulderLoad), "C1");
  EXPECT_STREQ(ToString(EffectClass::kWristMotion), "C9");
  EXPECT_STREQ(Advice(EffectClass::kLengthUnit), "a second length standard");
}

TEST(DriverWords, AJointsOwnAngleNeedsNoNumber) {
  EXPECT_EQ(DriverWords({DriverKind::kJointAngle, 3}, 3), "joint angle");
  EXPECT_EQ(DriverWords({DriverKind::kJointAngle, 4}, 5), "angle of joint 4");
  EXPECT_EQ(DriverWords({DriverKind::kSignOfGravityTorque, 2}, 2), "sign of gravity torque");
  EXPECT_EQ(DriverWords({DriverKind::kConstant}, 0), "constant");
}

}  // namespace
}  // namespace dhcal
