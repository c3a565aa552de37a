// The circumstances of every pose of a recording, as effects need them: joint angles, axes,
// gravity loads, approach directions, time.
#ifndef DHCAL_CORE_PHYSICS_CONTEXT_H_
#define DHCAL_CORE_PHYSICS_CONTEXT_H_

#include <algorithm>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/kinematics/dh_chain.h"
#include "core/model/recording.h"
#include "core/model/robot.h"

namespace dhcal {

/// A twist of all that lies beyond some place of the chain, in base coordinates.
struct Twist {
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     // [rad]
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // [m] of the point `at`
  Eigen::Vector3d at = Eigen::Vector3d::Zero();           // [m]
};

/// Loads bend the arm, and the bent arm has other loads: this often is enough.
constexpr int kBends = 2;

/// Immutable. Joints and links count from 0 here. Everything is at the nominal robot, unless the
/// context was made at another state of it.
class PhysicsContext {
 public:
  /// `X_WB`: base of each run, or of each edge (one entry = the same for all). `robot` and
  /// `recording` must outlive the context.
  PhysicsContext(const RobotModel& robot,
                 const Recording& recording,
                 std::vector<Eigen::Isometry3d> X_WB);
  /// At the robot as it stands: `deltas` (slots x rows) are added to the joints' slots. Loads and
  /// axes of a robot that bends are those of the bent one.
  PhysicsContext(const RobotModel& robot,
                 const Recording& recording,
                 std::vector<Eigen::Isometry3d> X_WB,
                 const Eigen::MatrixXd& deltas);
  /// The same circumstances of a robot that differs in its masses only.
  PhysicsContext(const PhysicsContext& other, const RobotModel& with_masses);

  const RobotModel& robot() const { return robot_; }
  const Recording& recording() const { return recording_; }
  const SlotLayout& slots() const { return chain_.slots(); }
  int num_rows() const { return recording_.num_rows(); }
  int num_joints() const { return robot_.num_joints(); }
  bool revolute(int joint) const { return row(joint).type == JointType::kRevolute; }

  /// Joint coordinate in DH's sense [rad or m], per row; without the row's offset.
  Eigen::VectorXd q(int joint) const { return row(joint).sign * recording_.q.col(joint); }
  /// True if a joint goes through enough of its travel to drive anything; the read-outs of one that
  /// is locked jitter.
  bool moves(int joint) const { return moves_[static_cast<std::size_t>(joint)]; }
  /// Slot that the joint drives: theta, or d of a prismatic one.
  int joint_slot(int joint) const {
    return slots().joint(joint, revolute(joint) ? JointSlot::kTheta : JointSlot::kD);
  }
  double sign(int joint) const { return row(joint).sign; }

  /// Frame of link `link` in B at a row; link -1 = the base itself.
  const Eigen::Isometry3d& X_BL(int row_idx, int link) const {
    return frames_[static_cast<std::size_t>(row_idx) * static_cast<std::size_t>(num_joints() + 1) +
                   static_cast<std::size_t>(link + 1)];
  }
  /// Unit vector of a joint's axis in B, and a point on it.
  Eigen::Vector3d axis(int row_idx, int joint) const {
    return X_BL(row_idx, axis_link(joint)).linear().col(2);
  }
  Eigen::Vector3d axis_point(int row_idx, int joint) const {
    return X_BL(row_idx, axis_link(joint)).translation();
  }
  const Eigen::Isometry3d& X_WB(int row_idx) const {
    if (X_WB_.size() == 1) return X_WB_[0];
    const int label = robot_.base_per_edge ? recording_.edge(row_idx) : recording_.run(row_idx);
    return X_WB_[static_cast<std::size_t>(std::max(label, 0))];
  }
  /// Where the nominal robot has the measured point Q, in W [m]. Never what was read: a column that
  /// held a reading would hold the residual, and explain it.
  Eigen::Vector3d p_WQ(int row_idx) const;
  /// Its pose there, with the tool moved as a state of the robot has it.
  Eigen::Isometry3d X_WQ(int row_idx) const;
  /// Anchor to which a row's distance is read; null where no distance is read.
  const Anchor* anchor(int row_idx) const;

  /// The six base slots' perturbation that moves Q as the twist does, to first order.
  Eigen::Matrix<double, 6, 1> AsBaseSlots(int row_idx, const Twist& twist) const;

  /// Payload of a row [kg]: its column, else the robot's.
  double payload(int row_idx) const;
  bool payload_varies() const;

  /// Sense (DH's) of each joint's last motion, -1, 0 or 1: the column, else from the previous rows
  /// of the run, where turning back by no more than read-outs jitter is rest. 0 = not known.
  const Eigen::MatrixXd& direction() const { return direction_; }
  /// Where that is not known because a joint that may count modulo a turn went more than half of
  /// one: its sense if it went as counted. Else 0.
  const Eigen::MatrixXd& direction_as_counted() const { return direction_as_counted_; }

  bool has_time() const { return recording_.time.size() > 0 && recording_.time.allFinite(); }
  /// True if, moreover, no run begins before the end of the one before it.
  bool has_one_clock() const { return has_one_clock_; }
  /// Seconds since the first row; the row's number where there is no clock for all runs.
  const Eigen::VectorXd& clock() const { return clock_; }
  /// Seconds since the first row of the run: drifts begin anew with each (FORMATS.md, section 1).
  const Eigen::VectorXd& drift_clock() const { return drift_clock_; }
  /// Of the longest run [s].
  double duration() const { return duration_; }

 private:
  const JointRow& row(int joint) const { return robot_.joints[static_cast<std::size_t>(joint)]; }
  /// Flange T to the point Q of a row's target or run.
  const Eigen::Isometry3d& X_TQ(int row_idx) const;
  int axis_link(int joint) const {
    return robot_.convention == DhConvention::kStandard ? joint - 1 : joint;
  }
  void FillMoves();
  void FillDirections();
  void FillClock();

  const RobotModel& robot_;
  const Recording& recording_;
  DhChain chain_;
  std::vector<Eigen::Isometry3d> X_WB_;
  std::vector<Eigen::Isometry3d> frames_;                                    // num_rows x (n + 1)
  Eigen::Matrix<double, SlotLayout::kPerFrame, Eigen::Dynamic> tool_moves_;  // per row
  std::vector<bool> moves_;
  Eigen::MatrixXd direction_, direction_as_counted_;
  Eigen::VectorXd clock_, drift_clock_;
  bool has_one_clock_ = false;
  double duration_ = 0;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_CONTEXT_H_
