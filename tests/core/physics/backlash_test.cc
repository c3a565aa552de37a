#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/physics/registry.h"
#include "core/physics/worked_example.h"

namespace dhcal {
namespace {

/// The sentence on 3e-4 of play at joint 4, and the unit in brackets.
std::string SentenceFor(JointType type) {
  RobotModel robot = WorkedExampleRobot();
  robot.joints[3].type = type;
  const Recording recording = WorkedExampleRecording();
  const PhysicsContext context(robot, recording, {robot.X_WB});
  const Effect& effect = *FindEffect("backlash");
  EffectRequest request;
  request.effect = "backlash";
  request.joint = 4;
  const EffectColumn column = effect.Columns(context, request).front();
  return effect.Sentence(context, request, {{column.parameter, column.unit, 3e-4, 1e-5}}) + " [" +
         column.unit + "]";
}

TEST(Backlash, IsAnAngleOfATurningJointAndALengthOfASlidingOne) {
  EXPECT_THAT(SentenceFor(JointType::kRevolute),
              testing::HasSubstr("0.300 +- 0.010 mrad of backlash"));
  EXPECT_THAT(SentenceFor(JointType::kRevolute), testing::EndsWith("[rad]"));
  EXPECT_THAT(SentenceFor(JointType::kPrismatic),
              testing::HasSubstr("0.300 +- 0.010 mm of backlash"));
  EXPECT_THAT(SentenceFor(JointType::kPrismatic), testing::EndsWith("[m]"));
}

}  // namespace
}  // namespace dhcal
