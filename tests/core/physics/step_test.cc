#include "core/physics/step.h"

#include <limits>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/physics/registry.h"
#include "core/physics/worked_example.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

/// Why a step with these settings cannot be seen in the worked example's rows (0, 3600, 7200 s).
std::string WhyNoStep(const std::map<std::string, double>& settings,
                      const Recording& rows = WorkedExampleRecording()) {
  const RobotModel robot = WorkedExampleRobot();
  const PhysicsContext context(robot, rows, {robot.X_WB});
  EffectRequest request;
  request.effect = "joint_step";
  request.joint = 2;
  request.settings = settings;
  return FindEffect(request.effect)->NotTestable(context, request);
}

TEST(Step, IsTestableAtAnInstantOfItsClock) {
  EXPECT_EQ(WhyNoStep({{"at_s", 3600}}), "");
  Recording rows = WorkedExampleRecording();
  rows.time.resize(0);
  EXPECT_EQ(WhyNoStep({{"at_row", 1}}, rows), "");
}

TEST(Step, SaysThatTheClockIsMissing) {
  Recording rows = WorkedExampleRecording();
  rows.time[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(WhyNoStep({{"at_s", 3600}}, rows), HasSubstr("the column t_s has blank cells"));
  rows.time.resize(0);
  EXPECT_THAT(WhyNoStep({{"at_s", 3600}}, rows), HasSubstr("the recording has no column t_s"));
}

TEST(Step, ATimeThatBeginsAnewInEachRunIsNoInstant) {
  Recording rows = WorkedExampleRecording();
  rows.run_names = {"a", "b"};
  rows.run_idx = {0, 0, 1};
  EXPECT_EQ(WhyNoStep({{"at_s", 3600}}, rows), "") << "one clock for both runs";
  rows.time[2] = 0;
  EXPECT_THAT(WhyNoStep({{"at_s", 3600}}, rows), HasSubstr("lies before that of the run before"));
  EXPECT_EQ(WhyNoStep({{"at_row", 1}}, rows), "");
}

TEST(Drift, BeginsAnewWithEachRun) {
  Recording rows = WorkedExampleRecording();  // 0, 3600, 7200 s
  rows.run_names.clear();
  rows.run_idx.clear();
  const RobotModel robot = WorkedExampleRobot();
  EXPECT_EQ(PhysicsContext(robot, rows, {robot.X_WB}).drift_clock(),
            Eigen::Vector3d(0, 3600, 7200));
  rows.run_names = {"a", "b"};
  rows.run_idx = {0, 1, 1};
  const PhysicsContext runs(robot, rows, {robot.X_WB});
  EXPECT_EQ(runs.drift_clock(), Eigen::Vector3d(0, 0, 3600));
  EXPECT_EQ(runs.clock(), Eigen::Vector3d(0, 3600, 7200));
  EXPECT_EQ(runs.duration(), 3600);
}

TEST(Step, HasOneInstant) {
  EXPECT_THAT(WhyNoStep({{"at_s", 3600}, {"at_row", 1}}), HasSubstr("keep one of them"));
}

TEST(Step, WithoutAnInstantNamesTheSettingThatTheRecordingAllows) {
  EXPECT_EQ(WhyNoStep({}), "needs the setting at_s");
  // The rows have a clock, by which a step is placed.
  EXPECT_EQ(WhyNoStep({{"at_row", 1}}), "needs the setting at_s");
}

TEST(EffectSettings, CountsAreWholeNumbersAndSwitchesOneOrZero) {
  ASSERT_TRUE(WholeSetting("driver_joint", 6).has_value());
  EXPECT_EQ(WholeSetting("driver_joint", 6)->high, 6);
  for (const char* const flag : {"flank", "measured_torque", "free_masses"}) {
    ASSERT_TRUE(WholeSetting(flag, 6).has_value()) << flag;
    EXPECT_EQ(WholeSetting(flag, 6)->high, 1) << flag;
  }
  for (const char* const any : {"order", "time_constant_s", "at_s", "soft_torque_Nm"}) {
    EXPECT_FALSE(WholeSetting(any, 6).has_value()) << any;
  }
}

TEST(EffectDescriptions, SayWhatABalancerAndACouplingNeed) {
  EXPECT_NE(FindEffect("gravity_balancer")->Describe().needs, "");
  EXPECT_NE(FindEffect("joint_coupling")->Describe().needs, "");
}

}  // namespace
}  // namespace dhcal
