#include <cmath>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/kinematics/dh_chain.h"
#include "core/physics/registry.h"
#include "core/physics/worked_example.h"
#include "tests/support/matchers.h"
#include "tests/support/ridders.h"

namespace dhcal {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const Effect& TheEffect() { return *FindEffect("column_driver"); }

EffectRequest Of(const std::string& column, const std::string& slot) {
  EffectRequest request;
  request.effect = "column_driver";
  request.words = {{"column", column}, {"slot", slot}};
  return request;
}

/// 40 random poses of the example arm, one a minute.
Recording RandomRecording() {
  Recording recording;
  Rng rng(41);
  recording.q.resize(40, 6);
  recording.time.resize(40);
  for (int row = 0; row < 40; ++row) {
    recording.time[row] = 60 * row;
    for (int joint = 0; joint < 6; ++joint) recording.q(row, joint) = rng.Uniform(-1, 1);
  }
  return recording;
}

/// Columns that the diagnosis would try of a recording that has `values` besides.
std::set<std::string> Tried(Recording recording, const Eigen::VectorXd& values) {
  recording.extra.push_back({"x", values});
  const RobotModel robot = WorkedExampleRobot();
  const PhysicsContext context(robot, recording, {robot.X_WB});
  std::set<std::string> columns;
  for (const EffectRequest& request : TheEffect().Candidates(context)) {
    EXPECT_EQ(TheEffect().NotTestable(context, request), "");
    columns.insert(request.word("column"));
  }
  return columns;
}

Eigen::VectorXd Noise(int rows) {
  Rng rng(42);
  Eigen::VectorXd values(rows);
  for (double& value : values) value = rng.Uniform(20, 30);
  return values;
}

TEST(ColumnDriver, AQuantityWithACourseOfItsOwnIsTried) {
  EXPECT_THAT(Tried(RandomRecording(), Noise(40)), testing::ElementsAre("x"));
  // Whatever its unit.
  EXPECT_THAT(Tried(RandomRecording(), 1e-9 * Noise(40)), testing::ElementsAre("x"));
  EXPECT_THAT(Tried(RandomRecording(), (1e6 + Noise(40).array()).matrix()),
              testing::ElementsAre("x"));
}

TEST(ColumnDriver, AConstantOrALabelIsNot) {
  EXPECT_THAT(Tried(RandomRecording(), Eigen::VectorXd::Constant(40, 7.5)), IsEmpty());
  Eigen::VectorXd label(40);
  for (int row = 0; row < 40; ++row) label[row] = row * 7 % 3;
  EXPECT_THAT(Tried(RandomRecording(), label), IsEmpty());
  Eigen::VectorXd peak = 1e-3 * Noise(40);
  peak[17] = 1000;
  EXPECT_THAT(Tried(RandomRecording(), peak), IsEmpty()) << "one row would be all that it says";
  Eigen::VectorXd blank = Noise(40);
  blank[3] = std::nan("");
  EXPECT_THAT(Tried(RandomRecording(), blank), IsEmpty());
}

TEST(ColumnDriver, WhatRepeatsTheClockOrAJointIsNot) {
  const Recording recording = RandomRecording();
  EXPECT_THAT(Tried(recording, (1.7e9 + recording.time.array()).matrix()), IsEmpty());
  EXPECT_THAT(Tried(recording, Eigen::VectorXd::LinSpaced(40, 1, 40)), IsEmpty());
  EXPECT_THAT(Tried(recording, -57.3 * recording.q.col(3)), IsEmpty());
  EXPECT_THAT(Tried(recording, recording.q.col(1) + recording.q.col(2)), IsEmpty());
  // A motor that warms up to a limit has its own course.
  const Eigen::VectorXd warm = 1 - (-recording.time.array() / 600).exp();
  EXPECT_THAT(Tried(recording, warm), testing::ElementsAre("x"));
}

TEST(ColumnDriver, WhatRepeatsAReadingIsNot) {
  Recording recording = RandomRecording();
  recording.p_WQ.setRandom(40, 3);
  EXPECT_THAT(Tried(recording, 1000 * recording.p_WQ.col(2)), IsEmpty());
}

TEST(ColumnDriver, OfSlotsThatMoveThePointAlikeOneIsTried) {
  Recording recording = RandomRecording();
  recording.extra.push_back({"x", Noise(40)});
  const RobotModel robot = WorkedExampleRobot();
  const PhysicsContext context(robot, recording, {robot.X_WB});
  std::set<std::string> slots;
  for (const EffectRequest& r : TheEffect().Candidates(context)) slots.insert(r.word("slot"));
  EXPECT_THAT(slots,
              testing::IsSupersetOf({"theta1",
                                     "theta5",
                                     "a2",
                                     "alpha2",
                                     "base_x",
                                     "base_z",
                                     "base_rx",
                                     "tool_x",
                                     "tool_y",
                                     "tool_z"}));
  // The height of the first row is that of the base, and so on; a point on the last axis does not
  // turn with it, and turns of the tool are not read.
  for (const char* const same : {"base_rz", "d1", "d3", "d6", "a6", "theta6", "tool_rz", "beta2"}) {
    EXPECT_EQ(slots.count(same), 0) << same;
  }
}

TEST(ColumnDriver, ItsColumnIsTheDerivativeOfTheSlot) {
  const RobotModel robot = WorkedExampleRobot();
  const Recording recording = WorkedExampleRecording();
  const PhysicsContext context(robot, recording, {robot.X_WB});
  const DhChain chain(robot);
  for (const char* const slot : {"theta3", "alpha2", "base_ry", "tool_x"}) {
    const EffectColumn column = TheEffect().Columns(context, Of("motor_temp", slot)).front();
    PoseWithDerivatives pose;
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(chain.slots().size());
    const EndFrames ends{robot.X_WB, robot.X_TQ};
    chain.PoseAndDerivatives(recording.q.row(1).transpose(), zero, ends, &pose);
    const SlotWeights& weights = column.slots.front();
    const VectorFunction moved = [&](const Eigen::VectorXd& rate) -> Eigen::VectorXd {
      Eigen::VectorXd delta = zero;
      delta[weights.slot] = rate[0] * weights.weight[1];
      return chain.Pose<double>(recording.q.row(1).transpose(), delta, ends).translation();
    };
    EXPECT_THAT(pose.J_p.col(weights.slot) * weights.weight[1],
                MatrixNear(RiddersColumn(moved, Eigen::VectorXd::Zero(1), 0, 1e-2), 1e-8))
        << slot;
  }
}

TEST(ColumnDriver, SaysWhatIsMissing) {
  const RobotModel robot = WorkedExampleRobot();
  const Recording recording = WorkedExampleRecording();
  const PhysicsContext context(robot, recording, {robot.X_WB});
  EXPECT_THAT(TheEffect().NotTestable(context, Of("", "theta3")), HasSubstr("setting column"));
  EXPECT_THAT(TheEffect().NotTestable(context, Of("motor", "theta3")), HasSubstr("motor_temp"));
  EXPECT_THAT(TheEffect().NotTestable(context, Of("motor_temp", "theta9")), HasSubstr("beta6"));
  EXPECT_EQ(TheEffect().NotTestable(context, Of("motor_temp", "tool_rz")), "");
}

TEST(ColumnDriver, SaysItsRateInAUnitThatFits) {
  const RobotModel robot = WorkedExampleRobot();
  const Recording recording = WorkedExampleRecording();
  const PhysicsContext context(robot, recording, {robot.X_WB});
  const auto sentence = [&](const std::string& slot, const EffectValue& value) {
    return TheEffect().Sentence(context, Of("motor_temp", slot), {value});
  };
  EXPECT_EQ(sentence("theta3", {"theta3", "rad per unit", 1.23e-5, 4e-7}),
            "theta3 follows the column 'motor_temp': 0.01230 +- 0.00040 mrad per unit of it");
  EXPECT_EQ(sentence("base_x", {"base_x", "m per unit", -3.1e-9, 2e-10}),
            "base_x follows the column 'motor_temp': -3.10 +- 0.20 nm per unit of it");
}

}  // namespace
}  // namespace dhcal
