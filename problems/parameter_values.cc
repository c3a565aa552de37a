#include "problems/parameter_values.h"

#include "core/kinematics/slots.h"
#include "core/math/rotation.h"
#include "core/model/joint_numbers.h"

namespace dhcal {
namespace {

/// The number of a row that a parameter corrects.
double JointRow::*NumberOfRow(const Parameter& p) {
  return NumberOf(SlotLayout::NumberAt(p.slot)).value;
}

const Eigen::Isometry3d& FrameOf(const Frames& frames, const Parameter& p) {
  return p.group == ParameterGroup::kBase ? frames.base(p.scope.row()) : frames.tool(p.scope.row());
}

int Component(const RobotModel& robot, const Parameter& p) {
  const SlotLayout slots(robot.num_joints());
  return p.slot - (p.group == ParameterGroup::kBase ? slots.base(0) : slots.tool(0));
}

bool IsFrame(const Parameter& p) {
  return p.group == ParameterGroup::kBase || p.group == ParameterGroup::kTool;
}

}  // namespace

RobotModel CalibratedRobot(const Calibration& c, const Eigen::VectorXd& state) {
  RobotModel robot = c.spec.robot;
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const Parameter& p = c.parameters[k];
    if (IsFrame(p) || p.effect_column >= 0) continue;
    JointRow& row = robot.joints[static_cast<std::size_t>(SlotLayout::JointOf(p.slot))];
    row.*NumberOfRow(p) += state[static_cast<Eigen::Index>(k)];
  }
  Frames frames = c.frames;
  frames.Apply(c.parameters, state, c.chain.slots());
  frames.Store(c.recording, &robot);
  return robot;
}

double ValueIn(const RobotModel& robot, const Frames& frames, const Parameter& p) {
  if (p.effect_column >= 0) return 0;
  if (!IsFrame(p)) {
    return robot.joints[static_cast<std::size_t>(SlotLayout::JointOf(p.slot))].*NumberOfRow(p);
  }
  const Eigen::Isometry3d& X = FrameOf(frames, p);
  const int component = Component(robot, p);
  return component < 3 ? X.translation()[component] : LogSO3(X.linear())[component - 3];
}

double Correction(const RobotModel& from,
                  const Frames& frames_from,
                  const RobotModel& to,
                  const Frames& frames_to,
                  const Parameter& p) {
  if (!IsFrame(p) || Component(from, p) < 3) {
    return ValueIn(to, frames_to, p) - ValueIn(from, frames_from, p);
  }
  const Eigen::Matrix3d turn =
      FrameOf(frames_to, p).linear() * FrameOf(frames_from, p).linear().transpose();
  return LogSO3(turn)[Component(from, p) - 3];
}

}  // namespace dhcal
