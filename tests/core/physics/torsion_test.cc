// The soft zone of a gear, as its maker states it.

#include <algorithm>

#include <gtest/gtest.h>

#include "core/physics/context.h"
#include "core/physics/registry.h"
#include "core/physics/worked_example.h"

namespace dhcal {
namespace {

TEST(TorsionNonlinearity, IsLinearUpToItsTorqueAndConstantBeyond) {
  const RobotModel robot = WorkedExampleRobot();
  const Recording recording = WorkedExampleRecording();
  const PhysicsContext context(robot, recording, {robot.X_WB});
  EffectRequest request;
  request.effect = "torsion_nonlinearity";
  request.joint = 2;
  request.settings["measured_torque"] = 1;
  EffectRequest compliance = request;
  compliance.effect = "joint_compliance";
  const Eigen::VectorXd torque = EffectColumns(context, compliance).front().slots.front().weight;
  const double largest = torque.cwiseAbs().maxCoeff();
  ASSERT_GT(largest, 0);
  request.settings["soft_torque_Nm"] = 0.4 * largest;
  const EffectColumn column = EffectColumns(context, request).front();
  EXPECT_EQ(column.parameter, "soft");
  for (int row = 0; row < context.num_rows(); ++row) {
    const double expected = std::clamp(torque[row], -0.4 * largest, 0.4 * largest);
    EXPECT_DOUBLE_EQ(column.slots.front().weight[row], expected) << row;
  }
  // Wider than any torque it is the compliance itself.
  request.settings["soft_torque_Nm"] = 2 * largest;
  EXPECT_EQ(EffectColumns(context, request).front().slots.front().weight, torque);
}

}  // namespace
}  // namespace dhcal
