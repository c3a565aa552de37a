// Which joints move, and in which sense they did last.
#include "core/physics/context.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/physics/registry.h"
#include "core/physics/worked_example.h"

namespace dhcal {
namespace {

/// Joint 1 goes through `angles`, the others stand still.
Recording OfJoint1(const std::vector<double>& angles) {
  Recording recording;
  recording.q.setZero(static_cast<Eigen::Index>(angles.size()), 6);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    recording.q(static_cast<Eigen::Index>(k), 0) = angles[k];
  }
  return recording;
}

std::vector<double> Directions(const Recording& recording) {
  const RobotModel robot = WorkedExampleRobot();
  const PhysicsContext context(robot, recording, {robot.X_WB});
  const Eigen::VectorXd column = context.direction().col(0);
  return {column.begin(), column.end()};
}

TEST(Direction, IsThatOfTheLastMotionAndUnknownBeforeTheFirst) {
  EXPECT_EQ(Directions(OfJoint1({0.1, 0.5, 0.5, 0.2, 0.2, 0.3})),
            (std::vector<double>{0, 1, 1, -1, -1, 1}));
}

TEST(Direction, OfAJointAtRestIsNotChangedByItsReadOutsJitter) {
  EXPECT_EQ(Directions(OfJoint1({0.1, 0.5, 0.5 - 2e-6, 0.5 + 3e-6, 0.2, 0.2 + 5e-6, 0.2 - 5e-6})),
            (std::vector<double>{0, 1, 1, 1, -1, -1, -1}));
  EXPECT_EQ(Directions(OfJoint1({0.1, 0.1 + 2e-7, 0.1 - 2e-7, 0.1 + 2e-7})),
            (std::vector<double>{0, 0, 0, 0}));
}

TEST(Direction, OfAStreamInStepsFinerThanTheJitterIsKnown) {
  std::vector<double> there, expected;
  for (int k = 0; k < 60; ++k) there.push_back(5e-6 * k);
  for (int k = 0; k < 60; ++k) there.push_back(5e-6 * (58 - k));
  const std::vector<double> direction = Directions(OfJoint1(there));
  EXPECT_EQ(direction[50], 1);
  EXPECT_EQ(direction.back(), -1);
}

TEST(Direction, AcrossMoreThanHalfATurnIsNotKnownButAsCounted) {
  const Recording recording = OfJoint1({-3.1, 3.1, 0.5, -3, -2.9});
  EXPECT_EQ(Directions(recording), (std::vector<double>{0, 0, -1, 0, 1}));
  const RobotModel robot = WorkedExampleRobot();
  const PhysicsContext context(robot, recording, {robot.X_WB});
  EXPECT_EQ(Eigen::VectorXd(context.direction_as_counted().col(0)).transpose(),
            (Eigen::RowVectorXd(5) << 0, 1, 0, -1, 0).finished());
}

TEST(Direction, CountsInEachRunByItself) {
  Recording recording = OfJoint1({0.1, 0.5, 0.2, 0.1});
  recording.run_names = {"a", "b"};
  recording.run_idx = {0, 1, 0, 1};
  EXPECT_EQ(Directions(recording), (std::vector<double>{0, 0, 1, -1}));
}

TEST(AJointAtRest, DrivesNothing) {
  const RobotModel robot = WorkedExampleRobot();
  constexpr int kRows = 60, kLocked = 3;
  Recording still;
  Rng rng(4);
  still.q.resize(kRows, 6);
  for (double& q : still.q.reshaped()) q = rng.Uniform(-1, 1);
  still.q.col(kLocked).setConstant(30 * kDegree);
  Recording jitters = still;
  for (double& q : jitters.q.col(kLocked)) q += 2e-7 * rng.Normal();
  const PhysicsContext context(robot, still, {robot.X_WB}), other(robot, jitters, {robot.X_WB});
  EXPECT_FALSE(other.moves(kLocked));
  EXPECT_TRUE(other.moves(kLocked - 1));
  int untestable = 0;
  for (const Effect* const effect : AllEffects()) {
    for (const EffectRequest& request : effect->Candidates(context)) {
      const std::string why = effect->NotTestable(context, request);
      EXPECT_EQ(effect->NotTestable(other, request), why) << InstanceName(request);
      if (request.joint == kLocked + 1 && !why.empty()) ++untestable;
    }
  }
  EXPECT_GE(untestable, 4);
}

}  // namespace
}  // namespace dhcal
