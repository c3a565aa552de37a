#include "core/kinematics/dh_chain.h"

#include <cmath>

#include <glog/logging.h>

namespace dhcal {
namespace {

using Eigen::Vector3d;

/// A frame that is moved along the chain factor by factor: axes and origin in W.
struct MovingFrame {
  Vector3d x, y, z, o;

  void TurnX(double angle) { Turn(angle, &y, &z); }
  void TurnY(double angle) { Turn(angle, &z, &x); }
  void TurnZ(double angle) { Turn(angle, &x, &y); }

  Eigen::Matrix3d R() const {
    Eigen::Matrix3d R;
    R << x, y, z;
    return R;
  }

 private:
  static void Turn(double angle, Vector3d* first, Vector3d* second) {
    const double c = std::cos(angle), s = std::sin(angle);
    const Vector3d turned = c * *first + s * *second;
    *second = c * *second - s * *first;
    *first = turned;
  }
};

/// Notes, per slot, the axis and the point it turns about, until the end point is known.
class SlotAxes {
 public:
  explicit SlotAxes(PoseWithDerivatives* pose) : pose_(pose) {}

  void Turns(int slot, const Vector3d& axis, const Vector3d& point) {
    pose_->J_w.col(slot) = axis;
    pose_->J_p.col(slot) = point;
  }
  void Shifts(int slot, const Vector3d& axis) {
    pose_->J_w.col(slot).setZero();
    pose_->J_p.col(slot) = axis;
  }
  /// Replaces the points by the movement of p.
  void Finish(const SlotLayout& slots, const Vector3d& p) {
    for (int slot = 0; slot < slots.size(); ++slot) {
      if (!slots.is_angle(slot)) continue;
      const Vector3d lever = p - pose_->J_p.col(slot);
      pose_->J_p.col(slot) = pose_->J_w.col(slot).cross(lever);
    }
  }

 private:
  PoseWithDerivatives* pose_;
};

}  // namespace

DhChain::DhChain(const RobotModel& robot) : robot_(robot), slots_(robot.num_joints()) {
  CHECK_GT(robot.num_joints(), 0);
}

void DhChain::PoseAndDerivatives(const Eigen::Ref<const Eigen::VectorXd>& q,
                                 const Eigen::Ref<const Eigen::VectorXd>& delta,
                                 const EndFrames& ends,
                                 PoseWithDerivatives* pose) const {
  CHECK_EQ(q.size(), num_joints());
  CHECK_EQ(delta.size(), slots_.size());
  pose->J_p.resize(3, slots_.size());
  pose->J_w.resize(3, slots_.size());
  SlotAxes axes(pose);

  const Eigen::Matrix<double, 6, 1> base = delta.segment<6>(slots_.base(0));
  const Eigen::Isometry3d X_WB = PerturbFrame<double>(ends.X_WB, base);
  MovingFrame frame{
      X_WB.linear().col(0), X_WB.linear().col(1), X_WB.linear().col(2), X_WB.translation()};
  const Eigen::Matrix3d w_base = LeftJacobianSO3<double>(base.tail<3>());
  for (int k = 0; k < 3; ++k) {
    axes.Shifts(slots_.base(k), Vector3d::Unit(k));
    axes.Turns(slots_.base(3 + k), w_base.col(k), frame.o);
  }

  for (int i = 0; i < num_joints(); ++i) {
    const Row<double> row = RowAt<double>(i, q[i], delta);
    const auto slot = [&](JointSlot kind) { return slots_.joint(i, kind); };
    if (robot_.convention == DhConvention::kStandard) {
      axes.Turns(slot(JointSlot::kTheta), frame.z, frame.o);
      axes.Shifts(slot(JointSlot::kD), frame.z);
      frame.TurnZ(row.theta);
      frame.o += row.d * frame.z + row.a * frame.x;
      axes.Shifts(slot(JointSlot::kA), frame.x);
      axes.Turns(slot(JointSlot::kAlpha), frame.x, frame.o);
      frame.TurnX(row.alpha);
      axes.Turns(slot(JointSlot::kBeta), frame.y, frame.o);
      frame.TurnY(row.beta);
    } else {
      axes.Turns(slot(JointSlot::kAlpha), frame.x, frame.o);
      axes.Shifts(slot(JointSlot::kA), frame.x);
      frame.TurnX(row.alpha);
      frame.o += row.a * frame.x;
      axes.Turns(slot(JointSlot::kBeta), frame.y, frame.o);
      frame.TurnY(row.beta);
      axes.Turns(slot(JointSlot::kTheta), frame.z, frame.o);
      axes.Shifts(slot(JointSlot::kD), frame.z);
      frame.TurnZ(row.theta);
      frame.o += row.d * frame.z;
    }
  }

  const Eigen::Matrix<double, 6, 1> tool = delta.segment<6>(slots_.tool(0));
  const Eigen::Isometry3d X_TQ = PerturbFrame<double>(ends.X_TQ, tool);
  const Eigen::Matrix3d R_WT = frame.R();
  pose->p_WQ = frame.o + R_WT * X_TQ.translation();
  pose->R_WQ = R_WT * X_TQ.linear();
  const Eigen::Matrix3d w_tool = R_WT * LeftJacobianSO3<double>(tool.tail<3>());
  for (int k = 0; k < 3; ++k) {
    axes.Shifts(slots_.tool(k), R_WT.col(k));
    axes.Turns(slots_.tool(3 + k), w_tool.col(k), pose->p_WQ);
  }
  axes.Finish(slots_, pose->p_WQ);
}

Eigen::Isometry3d DhChain::FlangePose(const Eigen::Ref<const Eigen::VectorXd>& q,
                                      const Eigen::Ref<const Eigen::VectorXd>& delta) const {
  Eigen::VectorXd joints_only = delta;
  joints_only.tail(2 * SlotLayout::kPerFrame).setZero();
  return Pose<double>(q, joints_only, EndFrames());
}

std::vector<Eigen::Isometry3d> DhChain::LinkFrames(
    const Eigen::Ref<const Eigen::VectorXd>& q) const {
  return LinkFrames(q, Eigen::VectorXd::Zero(slots_.size()));
}

std::vector<Eigen::Isometry3d> DhChain::LinkFrames(
    const Eigen::Ref<const Eigen::VectorXd>& q,
    const Eigen::Ref<const Eigen::VectorXd>& delta) const {
  const Eigen::VectorXd perturbed = delta;
  std::vector<Eigen::Isometry3d> frames{Eigen::Isometry3d::Identity()};
  for (int i = 0; i < num_joints(); ++i) {
    frames.push_back(frames.back() * LinkTransform<double>(RowAt<double>(i, q[i], perturbed)));
  }
  return frames;
}

}  // namespace dhcal
