#include "problems/formats/problem/effect_checks.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/temp_file.h"

namespace dhcal {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr char kThreeRows[] =
    "q1_deg,q2_deg,q3_deg,x_mm,y_mm,z_mm\n0,10,20,1,1,1\n30,-40,50,1,1,1\n-60,70,-80,1,1,1\n";

/// Every message about effects (lines of the list, the first in line 11) for a recording.
std::string EffectMessages(const std::string& effects, const std::string& rows = kThreeRows) {
  const TempFile problem(
      "schema: 1\n"
      "robot:\n"
      "  joints:\n"
      "    - {d_m: 0.5, alpha_deg: 90}\n"
      "    - {a_m: 0.4}\n"
      "    - {a_m: 0.3}\n"
      "measurement: {kind: position}\n"
      "recording: rows.csv\n"
      "parameters:\n"
      "  effects:\n" +
          effects,
      ".yaml");
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(problem.path(), "", &diagnostics);
  EXPECT_TRUE(spec.has_value()) << diagnostics.ToString();
  if (!spec) return diagnostics.ToString();
  const TempFile file(rows, ".csv");
  const auto recording = ReadRecording(file.path(), spec->robot.joints, &diagnostics);
  EXPECT_TRUE(recording.has_value()) << diagnostics.ToString();
  if (!recording) return diagnostics.ToString();
  CheckEffectsFit(*spec, *recording, &diagnostics);
  return diagnostics.ToString();
}

TEST(EffectChecks, ValuesOfTheEffectsOwnParametersFit) {
  EXPECT_EQ(EffectMessages("    - {effect: joint_gain, joint: 2, values: {gain: 1e-4}}\n"
                           "    - {effect: gear_harmonic, joint: 3, order: 5, values: {sin_5: "
                           "1e-5}}\n"),
            "");
}

TEST(EffectChecks, ValueWithoutAParameterIsRefusedWithItsPlaceAndTheParameters) {
  EXPECT_THAT(EffectMessages("    - {effect: gear_harmonic, joint: 2, order: 5, values: {sin_1: "
                             "1e-5, cos_5: 0}}\n"),
              AllOf(HasSubstr(".yaml:11:7: error: the effect gear_harmonic at joint 2 (order 5) "
                              "cannot be held at its values: it has no parameter 'sin_1'"),
                    HasSubstr("; its parameters are sin_5, cos_5")));
}

TEST(EffectChecks, EachWrongValueGivesOneMessage) {
  const std::string messages = EffectMessages(
      "    - {effect: joint_gain, joint: 2, values: {gain: 1e-4, with: 1, width: 2}}\n");
  EXPECT_THAT(messages, AllOf(HasSubstr("'with'"), HasSubstr("'width'"), Not(HasSubstr("'gain'"))));
}

TEST(EffectChecks, ValueThatNeedsAColumnIsRefusedWithoutIt) {
  const std::string effect =
      "    - {effect: joint_compliance, joint: 2, values: {compliance: 3e-6}}\n";
  EXPECT_EQ(EffectMessages(effect,
                           "q1_deg,q2_deg,q3_deg,x_mm,y_mm,z_mm,payload_kg\n"
                           "0,10,20,1,1,1,0\n30,-40,50,1,1,1,5\n"),
            "");
  // Neither masses nor a payload that varies: only products with moments can be known.
  EXPECT_THAT(EffectMessages(effect), HasSubstr("it has no parameter 'compliance'"));
}

TEST(EffectChecks, ADriverMustBeAColumnThatIsThereAndActOnASlot) {
  const std::string rows =
      "q1_deg,q2_deg,q3_deg,x_mm,y_mm,z_mm,motor_temp\n0,10,20,1,1,1,30\n30,-40,50,1,1,1,35\n";
  const auto messages = [&](const std::string& words) {
    return EffectMessages("    - {effect: column_driver, " + words + "}\n", rows);
  };
  EXPECT_THAT(messages("column: motor_temp, slot: theta2"), Not(HasSubstr("error")));
  EXPECT_THAT(messages("column: motor_temp, slot: theta2, values: {theta2: 1e-5}"),
              Not(HasSubstr("error")));
  EXPECT_THAT(messages("column: motor, slot: theta2"),
              AllOf(HasSubstr("the effect column_driver (column motor, slot theta2) cannot be"),
                    HasSubstr("has no column 'motor'"),
                    HasSubstr("it has motor_temp")));
  EXPECT_THAT(messages("column: motor_temp"), HasSubstr("needs the setting slot"));
  EXPECT_THAT(messages("slot: theta2"), HasSubstr("needs the setting column"));
}

TEST(EffectChecks, CurveMayBeHeldWhereTheRecordingDoesNotGo) {
  const std::string effect = "    - {effect: transmission_error, joint: 2, values: {at_150: 1e-4";
  EXPECT_EQ(EffectMessages(effect + "}}\n"), "");
  EXPECT_THAT(EffectMessages(effect + ", at_151: 1e-4}}\n"),
              AllOf(HasSubstr("it has no parameter 'at_151'"), HasSubstr("(120 in all)")));
}

TEST(EffectChecks, SameEffectThroughADefaultIsRefused) {
  EXPECT_THAT(EffectMessages("    - {effect: gear_harmonic, joint: 2, order: 1}\n"
                             "    - {effect: gear_harmonic, joint: 2}\n"),
              AllOf(HasSubstr(".yaml:12:7: error: the effect gear_harmonic at joint 2 asks for the "
                              "same effect a second time, first in line 11"),
                    HasSubstr("keep one of them")));
  EXPECT_THAT(EffectMessages("    - {effect: joint_coupling, joint: 2}\n"
                             "    - {effect: joint_coupling, joint: 2, driver_joint: 1}\n"),
              HasSubstr("asks for the same effect a second time"));
}

TEST(EffectChecks, OneEffectWithOtherSettingsOrAtAnotherJointFits) {
  EXPECT_EQ(EffectMessages("    - {effect: gear_harmonic, joint: 2}\n"
                           "    - {effect: gear_harmonic, joint: 2, order: 2}\n"
                           "    - {effect: gear_harmonic, joint: 3}\n"
                           "    - {effect: joint_coupling, joint: 3}\n"
                           "    - {effect: joint_coupling, joint: 3, driver_joint: 1}\n"),
            "");
}

TEST(EffectChecks, InstantOnAClockThatTheRecordingLacksNamesTheColumn) {
  const std::string messages = EffectMessages("    - {effect: joint_step, joint: 2, at_s: 30}\n");
  EXPECT_THAT(messages,
              AllOf(HasSubstr("the effect joint_step at joint 2 (at_s 30) cannot be estimated"),
                    HasSubstr("the recording has no column t_s")));
}

}  // namespace
}  // namespace dhcal
