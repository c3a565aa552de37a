#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kinematics/dh_chain.h"
#include "core/physics/registry.h"
#include "core/physics/worked_example.h"
#include "tests/support/matchers.h"

namespace dhcal {
namespace {

EffectRequest BySteadyClock() {
  EffectRequest request;
  request.effect = "instrument_drift";
  request.settings["time_constant_s"] = 0;
  return request;
}

EffectColumn ColumnOf(const RobotModel& robot, const Recording& recording) {
  const PhysicsContext context(robot, recording, {robot.X_WB});
  return FindEffect("instrument_drift")->Columns(context, BySteadyClock()).front();
}

/// Where the model has the point of row 1 once the scale has grown by `scale` there.
Eigen::Vector3d PointOfRowOne(const RobotModel& robot, const Recording& recording, double scale) {
  const DhChain chain(robot);
  Eigen::VectorXd delta = Eigen::VectorXd::Zero(chain.slots().size());
  for (const SlotWeights& slot : ColumnOf(robot, recording).slots) {
    delta[slot.slot] += scale * slot.weight[1];
  }
  return chain.Pose<double>(recording.q.row(1).transpose(), delta, {robot.X_WB, robot.X_TQ})
      .translation();
}

/// With the instrument 4 m away and its axes turned.
RobotModel SeenFromAfar() {
  RobotModel robot = WorkedExampleRobot();
  robot.X_WB = Eigen::Translation3d(4, -1, 0.5) *
               Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  return robot;
}

TEST(InstrumentDrift, PositionsGrowAboutTheOriginOfTheInstrument) {
  const RobotModel robot = SeenFromAfar();
  Recording recording = WorkedExampleRecording();
  recording.distance.resize(0);
  const Eigen::Vector3d cold = PointOfRowOne(robot, recording, 0);
  EXPECT_THAT(PointOfRowOne(robot, recording, 1e-3), MatrixNear(1.001 * cold, 1e-12));
}

TEST(InstrumentDrift, DistancesGrowAboutTheirAnchor) {
  const RobotModel robot = SeenFromAfar();
  const Recording recording = WorkedExampleRecording();
  const Eigen::Vector3d anchor = robot.anchors.front().p_WA;
  const double cold = (PointOfRowOne(robot, recording, 0) - anchor).norm();
  EXPECT_NEAR((PointOfRowOne(robot, recording, 1e-3) - anchor).norm(), 1.001 * cold, 1e-12);
}

TEST(InstrumentDrift, NoColumnDependsOnAReading) {
  const RobotModel robot = SeenFromAfar();
  Recording recording = WorkedExampleRecording();
  const EffectColumn before = ColumnOf(robot, recording);
  recording.p_WQ = Eigen::MatrixXd::Constant(recording.num_rows(), 3, 7.0);
  recording.distance.setConstant(9);
  const EffectColumn after = ColumnOf(robot, recording);
  for (std::size_t k = 0; k < before.slots.size(); ++k) {
    EXPECT_EQ(before.slots[k].weight, after.slots[k].weight);
  }
}

TEST(InstrumentDrift, NeedsTheAnchorsOfDistances) {
  const RobotModel robot = WorkedExampleRobot();
  Recording recording = WorkedExampleRecording();
  recording.distance.resize(0);
  const PhysicsContext context(robot, recording, {robot.X_WB});
  EXPECT_THAT(FindEffect("instrument_drift")->NotTestable(context, BySteadyClock()),
              testing::HasSubstr("anchor"));
}

TEST(InstrumentDrift, SaysItsSizeInPartsPerMillion) {
  const RobotModel robot = WorkedExampleRobot();
  const Recording recording = WorkedExampleRecording();
  const PhysicsContext context(robot, recording, {robot.X_WB});
  const std::string sentence =
      FindEffect("instrument_drift")
          ->Sentence(context, BySteadyClock(), {{"scale", "1", 42e-6, 1.5e-6}});
  EXPECT_EQ(sentence,
            "the instrument's scale drifts steadily over the recording: its readings grow by 42.0 "
            "+- 1.5 ppm");
}

}  // namespace
}  // namespace dhcal
