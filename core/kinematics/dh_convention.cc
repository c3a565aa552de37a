// Standard rows for modified ones and the reverse. A chain is a product of factors
//
//   Rz Tz | Tx Rx Ry | Rz Tz | Tx Rx Ry ...
//
// standard rows cut it before each Rz, modified rows before each Tx Rx = Rx Tx.
#include <cstddef>

#include "core/kinematics/dh_chain.h"
#include "core/kinematics/dh_rows.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;

/// The factors between two axes.
struct Between {
  double a = 0, alpha = 0, beta = 0;  // [m] [rad] [rad]

  static Between Of(const JointRow& row) { return {row.a, row.alpha, row.beta}; }
  void Put(JointRow* row) const {
    row->a = a;
    row->alpha = alpha;
    row->beta = beta;
  }
  Isometry3d Pose() const {
    RobotModel robot;
    robot.joints.emplace_back();
    Put(&robot.joints.front());
    return DhChain(robot).LinkFrames(Eigen::VectorXd::Zero(1)).back();
  }
};

RobotModel Modified(RobotModel robot) {
  Between before;  // nothing
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Between behind = Between::Of(robot.joints[j]);
    before.Put(&robot.joints[j]);
    if (j < robot.links.size()) robot.links[j].p_LC = behind.Pose() * robot.links[j].p_LC;
    before = behind;
  }
  robot.convention = DhConvention::kModified;
  FoldIntoEnds(Isometry3d::Identity(), before.Pose(), &robot);
  return robot;
}

RobotModel Standard(RobotModel robot) {
  Between behind;  // nothing
  for (std::size_t j = robot.joints.size(); j-- > 0;) {
    const Between before = Between::Of(robot.joints[j]);
    behind.Put(&robot.joints[j]);
    if (j < robot.links.size()) robot.links[j].p_LC = behind.Pose().inverse() * robot.links[j].p_LC;
    behind = before;
  }
  robot.convention = DhConvention::kStandard;
  FoldIntoEnds(behind.Pose(), Isometry3d::Identity(), &robot);
  return robot;
}

}  // namespace

void FoldIntoEnds(const Isometry3d& X_before, const Isometry3d& X_behind, RobotModel* robot) {
  robot->X_WB = robot->X_WB * X_before;
  for (RunFrame& frame : robot->base_of_run) frame.X = frame.X * X_before;
  // Gravity is given in the frame of the base that the file has.
  robot->gravity_B = X_before.linear().transpose() * robot->gravity_B;
  robot->X_TQ = X_behind * robot->X_TQ;
  for (RunFrame& frame : robot->tool_of_run) frame.X = X_behind * frame.X;
  for (Target& target : robot->targets) target.X_TQ = X_behind * target.X_TQ;
  robot->payload.p_LC = X_behind * robot->payload.p_LC;
}

RobotModel InConvention(const RobotModel& robot, DhConvention convention) {
  if (robot.convention == convention) return robot;
  return convention == DhConvention::kModified ? Modified(robot) : Standard(robot);
}

}  // namespace dhcal
