#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
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

/// One turning joint about a level axis that carries 2 kg at 0.5 m: torque -9.81 cos(q) N m.
TEST(Backlash, OfALoadedGearIsTheLoadsBeyondFrictionAndTheLastMotionsWithin) {
  RobotModel robot;
  robot.joints.resize(1);
  robot.joints[0].type = JointType::kRevolute;
  robot.links = {{2, Eigen::Vector3d(0.5, 0, 0)}};
  robot.gravity_B = {0, -9.81, 0};
  Recording recording;
  recording.q = Eigen::Vector4d(0, 0.25, 0.45, 1) * kPi;  // torque -9.81, -6.9, -1.5, +9.81
  recording.numbers = Eigen::Vector4d(1, 2, 3, 4);
  recording.direction = Eigen::Vector4d(1, 1, 1, -1);
  EffectRequest request;
  request.effect = "backlash";
  request.joint = 1;
  request.settings = {{"flank", 1}};
  const auto weights = [&] {
    const PhysicsContext context(robot, recording, {robot.X_WB});
    const EffectColumn column = FindEffect("backlash")->Columns(context, request).front();
    return Eigen::VectorXd(column.slots.front().weight);
  };
  EXPECT_EQ(weights(), Eigen::Vector4d(-0.5, -0.5, -0.5, 0.5));
  request.settings["friction_Nm"] = 3;
  EXPECT_EQ(weights(), Eigen::Vector4d(-0.5, -0.5, -0.5, 0.5));
  recording.direction(2, 0) = -1;
  EXPECT_EQ(weights(), Eigen::Vector4d(-0.5, -0.5, 0.5, 0.5)) << "the link stays behind";
  request.settings["friction_Nm"] = 20;
  EXPECT_EQ(weights(), Eigen::VectorXd(-0.5 * recording.direction.col(0)));
}

/// Counted from -177 to 177 degrees: by 354 one way, or by 6 the other.
TEST(Backlash, OfAJointThatCountsModuloATurnIsTriedEitherWayRound) {
  const RobotModel robot = WorkedExampleRobot();
  Recording recording;
  recording.q = Eigen::MatrixXd::Zero(3, 6);
  recording.q.col(0) << -3.1, 3.1, 0.5;
  const PhysicsContext context(robot, recording, {robot.X_WB});
  EffectRequest request;
  request.effect = "backlash";
  request.joint = 1;
  const auto weights = [&](double jumps) {
    request.settings["jumps"] = jumps;
    const EffectColumn column = FindEffect("backlash")->Columns(context, request).front();
    return Eigen::VectorXd(column.slots.front().weight);
  };
  EXPECT_EQ(weights(0), Eigen::Vector3d(0, 0, -0.5));
  EXPECT_EQ(weights(1), Eigen::Vector3d(0, 0.5, -0.5));
  EXPECT_EQ(weights(-1), Eigen::Vector3d(0, -0.5, -0.5));
  int tried = 0;
  for (const EffectRequest& candidate : FindEffect("backlash")->Candidates(context)) {
    if (candidate.joint == 1 && candidate.settings.count("jumps") > 0) ++tried;
  }
  EXPECT_EQ(tried, 2);
}

/// A turning joint whose link's x points along gravity at q = 0: with the moment along that x,
/// turned by m, the torque's sense is that of -sin(q + m).
TEST(Backlash, OfALoadedGearWithoutMassesFollowsTheSenseOfOneMoment) {
  for (const DhConvention convention : {DhConvention::kStandard, DhConvention::kModified}) {
    RobotModel robot;
    robot.convention = convention;
    robot.joints.resize(1);
    robot.joints[0].type = JointType::kRevolute;
    robot.joints[0].alpha = convention == DhConvention::kStandard ? 0.7 : 0;
    robot.gravity_B = {9.81, 0, 0};
    Recording recording;
    recording.q = Eigen::Vector4d(0.4, 2.9, 3.3, -0.6);
    recording.numbers = Eigen::Vector4d(1, 2, 3, 4);
    recording.direction = Eigen::Vector4d(1, 1, 1, 1);
    const PhysicsContext context(robot, recording, {robot.X_WB});
    const Effect& backlash = *FindEffect("backlash");
    EffectRequest request;
    request.effect = "backlash";
    request.joint = 1;
    request.settings = {{"flank", 1}};
    EXPECT_NE(backlash.NotTestable(context, request), "") << "there are no masses";
    request.settings["moment_link"] = 1;
    for (const double degrees : {0.0, 50.0, 140.0}) {
      request.settings["moment_deg"] = degrees;
      EXPECT_EQ(backlash.NotTestable(context, request), "");
      const EffectColumn column = backlash.Columns(context, request).front();
      for (int row = 0; row < 4; ++row) {
        const double sense = -std::sin(recording.q(row, 0) + degrees * kDegree);
        EXPECT_EQ(column.slots.front().weight[row], std::copysign(0.5, sense)) << degrees;
      }
    }
    request.settings["moment_link"] = 2;
    EXPECT_NE(backlash.NotTestable(context, request), "") << "the arm has one link";
  }
}

}  // namespace
}  // namespace dhcal
