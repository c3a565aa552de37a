// What holds for the columns of all effects.
#include "core/physics/columns.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/physics/registry.h"
#include "core/physics/worked_example.h"

namespace dhcal {
namespace {

/// Replaces all that was measured by random numbers.
void ScrambleReadings(Recording* recording) {
  Rng rng(17);
  for (Eigen::MatrixXd* const read :
       {&recording->p_WQ, &recording->displacement, &recording->quaternion}) {
    for (double& value : read->reshaped()) value = rng.Uniform(-1, 1);
  }
  for (double& value : recording->distance) value = rng.Uniform(0, 1);
}

TEST(EffectColumns, DoNotDependOnAReading) {
  const RobotModel robot = WorkedExampleRobot();
  Recording recording = WorkedExampleRecording();
  recording.p_WQ.setZero(recording.num_rows(), 3);
  recording.displacement.setZero(recording.num_rows(), 3);
  recording.quaternion.setZero(recording.num_rows(), 4);
  recording.distance.setZero(recording.num_rows());
  Recording scrambled = recording;
  ScrambleReadings(&scrambled);
  const PhysicsContext context(robot, recording, {robot.X_WB});
  const PhysicsContext other(robot, scrambled, {robot.X_WB});
  for (const Effect* const effect : AllEffects()) {
    for (const EffectRequest& request : effect->Candidates(context)) {
      ASSERT_EQ(effect->NotTestable(context, request), effect->NotTestable(other, request));
      if (!effect->NotTestable(context, request).empty()) continue;
      const auto columns = effect->Columns(context, request);
      const auto after = effect->Columns(other, request);
      ASSERT_EQ(columns.size(), after.size());
      for (std::size_t k = 0; k < columns.size(); ++k) {
        for (std::size_t i = 0; i < columns[k].slots.size(); ++i) {
          EXPECT_EQ(columns[k].slots[i].weight, after[k].slots[i].weight) << InstanceName(request);
        }
      }
    }
  }
}

TEST(PredictedPoint, IsThatOfTheRowsOwnTargetOrRun) {
  RobotModel robot = WorkedExampleRobot();
  Recording recording = WorkedExampleRecording();
  const int n = recording.num_rows();
  recording.target_names = {"B", "A"};
  recording.target_idx.assign(static_cast<std::size_t>(n), 0);
  recording.target_idx[1] = 1;
  robot.targets = {{"A", Eigen::Isometry3d::Identity()}, {"B", Eigen::Isometry3d::Identity()}};
  robot.targets[1].X_TQ.translation().z() = 0.5;
  const PhysicsContext context(robot, recording, {robot.X_WB});
  const auto flange = [&](int row) { return context.X_BL(row, context.num_joints() - 1); };
  EXPECT_LT((context.p_WQ(1) - robot.X_WB * flange(1).translation()).norm(), 1e-15);
  EXPECT_NEAR((context.p_WQ(0) - robot.X_WB * flange(0).translation()).norm(), 0.5, 1e-15);
}

TEST(AmountOfJoint, IsAnAngleOrALengthByTheValuesUnit) {
  EXPECT_EQ(AmountOfJoint({"step", "rad", 3e-4, 1e-5}), "0.300 +- 0.010 mrad");
  EXPECT_EQ(AmountOfJoint({"step", "m", 3e-4, 1e-5}), "0.300 +- 0.010 mm");
  EXPECT_EQ(AmountOfJoint({"drift", "m/K", 3e-4, 1e-5}), "0.300 +- 0.010 mm/K");
}

}  // namespace
}  // namespace dhcal
