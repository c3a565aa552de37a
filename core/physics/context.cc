#include "core/physics/context.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <glog/logging.h>

#include "core/base/units.h"

namespace dhcal {
namespace {

// A joint that goes less far drives nothing that shows: the finest pattern that is looked for, a
// gear's line of order 330, has a period of 19 mrad; screws and racks have pitches of millimetres.
constexpr double kMoves = 1e-3;  // [rad or m]
// To turn back by less is to stand still: read-outs of a joint at rest jitter by a few urad, and at
// a reach of a metre this is a tracker's noise.
constexpr double kAtRest = 2e-5;  // [rad or m]
constexpr double kFillsTheTurn = 1.9 * kPi;

/// Sense in which a joint moved last. A joint at rest keeps the flank on which it came to rest.
class LastMotion {
 public:
  void GoTo(double q) {
    if (sense_ <= 0) low_ = std::min(low_, q);
    if (sense_ >= 0) high_ = std::max(high_, q);
    if (sense_ <= 0 && q > low_ + kAtRest) {
      sense_ = 1;
      high_ = q;
    } else if (sense_ >= 0 && q < high_ - kAtRest) {
      sense_ = -1;
      low_ = q;
    }
  }
  void Set(double q, double sense) {
    low_ = high_ = q;
    sense_ = sense;
  }
  double sense() const { return sense_; }

 private:
  // Furthest since the last turn, against the sense and along it; both before the first motion.
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  double sense_ = 0;
};

}  // namespace

PhysicsContext::PhysicsContext(const RobotModel& robot,
                               const Recording& recording,
                               std::vector<Eigen::Isometry3d> X_WB)
    : PhysicsContext(
          robot,
          recording,
          std::move(X_WB),
          Eigen::MatrixXd::Zero(SlotLayout(robot.num_joints()).size(), recording.num_rows())) {}

PhysicsContext::PhysicsContext(const RobotModel& robot,
                               const Recording& recording,
                               std::vector<Eigen::Isometry3d> X_WB,
                               const Eigen::MatrixXd& deltas)
    : robot_(robot), recording_(recording), chain_(robot), X_WB_(std::move(X_WB)) {
  CHECK(!X_WB_.empty());
  CHECK_EQ(deltas.rows(), slots().size());
  CHECK_EQ(deltas.cols(), num_rows());
  frames_.reserve(static_cast<std::size_t>(num_rows()) *
                  static_cast<std::size_t>(num_joints() + 1));
  for (int k = 0; k < num_rows(); ++k) {
    const auto frames = chain_.LinkFrames(recording_.q.row(k).transpose(), deltas.col(k));
    frames_.insert(frames_.end(), frames.begin(), frames.end());
  }
  tool_moves_ = deltas.middleRows(slots().tool(0), SlotLayout::kPerFrame);
  FillMoves();
  FillDirections();
  FillClock();
}

PhysicsContext::PhysicsContext(const PhysicsContext& other, const RobotModel& with_masses)
    : robot_(with_masses),
      recording_(other.recording_),
      chain_(other.chain_),
      X_WB_(other.X_WB_),
      frames_(other.frames_),
      tool_moves_(other.tool_moves_),
      moves_(other.moves_),
      direction_(other.direction_),
      direction_as_counted_(other.direction_as_counted_),
      clock_(other.clock_),
      drift_clock_(other.drift_clock_),
      has_one_clock_(other.has_one_clock_),
      duration_(other.duration_) {}

const Eigen::Isometry3d& PhysicsContext::X_TQ(int row_idx) const {
  if (!recording_.target_idx.empty()) {
    const std::string& name =
        recording_.target_names[static_cast<std::size_t>(recording_.target(row_idx))];
    for (const Target& target : robot_.targets) {
      if (target.name == name) return target.X_TQ;
    }
  }
  if (!recording_.run_idx.empty()) {
    const std::string& name =
        recording_.run_names[static_cast<std::size_t>(recording_.run(row_idx))];
    for (const RunFrame& tool : robot_.tool_of_run) {
      if (tool.run == name) return tool.X;
    }
  }
  return robot_.first_X_TQ();
}

Eigen::Vector3d PhysicsContext::p_WQ(int row_idx) const {
  return X_WB(row_idx) * (X_BL(row_idx, num_joints() - 1) * X_TQ(row_idx).translation());
}

Eigen::Isometry3d PhysicsContext::X_WQ(int row_idx) const {
  const Eigen::Matrix<double, SlotLayout::kPerFrame, 1> moved = tool_moves_.col(row_idx);
  return X_WB(row_idx) * X_BL(row_idx, num_joints() - 1) *
         PerturbFrame<double>(X_TQ(row_idx), moved);
}

const Anchor* PhysicsContext::anchor(int row_idx) const {
  if (recording_.distance.size() == 0 || recording_.anchor_idx.empty()) return nullptr;
  const int idx = recording_.anchor_idx[static_cast<std::size_t>(row_idx)];
  if (idx < 0) return nullptr;
  const std::string& name = recording_.anchor_names[static_cast<std::size_t>(idx)];
  const auto found = std::find_if(robot_.anchors.begin(),
                                  robot_.anchors.end(),
                                  [&](const Anchor& anchor) { return anchor.name == name; });
  return found == robot_.anchors.end() ? nullptr : &*found;
}

Eigen::Matrix<double, 6, 1> PhysicsContext::AsBaseSlots(int row_idx, const Twist& twist) const {
  // Beyond the place, p moves by translation + rotation x (p - at); a base perturbation moves it by
  // t + rotation x p (p from the base's origin).
  const Eigen::Matrix3d R_WB = X_WB(row_idx).linear();
  Eigen::Matrix<double, 6, 1> slots;
  slots.head<3>() = R_WB * (twist.translation - twist.rotation.cross(twist.at));
  slots.tail<3>() = R_WB * twist.rotation;
  return slots;
}

double PhysicsContext::payload(int row_idx) const {
  if (recording_.payload.size() > 0 && std::isfinite(recording_.payload[row_idx])) {
    return recording_.payload[row_idx];
  }
  return robot_.payload.mass;
}

bool PhysicsContext::payload_varies() const {
  for (int k = 1; k < num_rows(); ++k) {
    if (std::abs(payload(k) - payload(0)) > 1e-6) return true;
  }
  return false;
}

void PhysicsContext::FillMoves() {
  for (int j = 0; j < num_joints(); ++j) {
    moves_.push_back(num_rows() > 0 &&
                     recording_.q.col(j).maxCoeff() - recording_.q.col(j).minCoeff() > kMoves);
  }
}

void PhysicsContext::FillDirections() {
  direction_.setZero(num_rows(), num_joints());
  direction_as_counted_ = direction_;
  const std::size_t num_runs = std::max<std::size_t>(recording_.run_names.size(), 1);
  for (int j = 0; j < num_joints(); ++j) {
    std::vector<LastMotion> of_run(num_runs);
    // Angles that fill the turn may be counted modulo 360 deg: then nobody knows how a joint came
    // across more than half of it.
    const auto q = recording_.q.col(j);
    const bool wraps = revolute(j) && num_rows() > 0 &&
                       q.maxCoeff() - q.minCoeff() > kFillsTheTurn &&
                       q.maxCoeff() - q.minCoeff() <= 2 * kPi;
    std::vector<int> last(num_runs, -1);
    for (int k = 0; k < num_rows(); ++k) {
      LastMotion& motion = of_run[static_cast<std::size_t>(recording_.run(k))];
      const bool given =
          recording_.direction.rows() > 0 && std::isfinite(recording_.direction(k, j));
      if (given) {
        motion.Set(recording_.q(k, j), recording_.direction(k, j));
      } else {
        motion.GoTo(recording_.q(k, j));
      }
      int& before = last[static_cast<std::size_t>(recording_.run(k))];
      const bool across = wraps && before >= 0 && std::abs(q[k] - q[before]) > kPi;
      before = k;
      const bool either_way = across && !given;
      (either_way ? direction_as_counted_ : direction_)(k, j) = sign(j) * motion.sense();
    }
  }
}

void PhysicsContext::FillClock() {
  clock_ = recording_.numbers.size() > 0
               ? recording_.numbers
               : Eigen::VectorXd::LinSpaced(num_rows(), 0, num_rows() - 1);
  drift_clock_ = clock_;
  if (num_rows() == 0) return;
  if (has_time()) {
    has_one_clock_ = true;
    double latest = recording_.time[0];
    for (int k = 1; k < num_rows(); ++k) {
      const bool new_run = recording_.run(k) != recording_.run(k - 1);
      if (new_run && recording_.time[k] < latest) has_one_clock_ = false;
      latest = std::max(latest, recording_.time[k]);
    }
    drift_clock_ = recording_.time;
    if (has_one_clock_) clock_ = recording_.time.array() - recording_.time.minCoeff();
  }
  std::map<int, double> start;  // of each run
  for (int k = 0; k < num_rows(); ++k) {
    double& first = start.try_emplace(recording_.run(k), drift_clock_[k]).first->second;
    first = std::min(first, drift_clock_[k]);
  }
  for (int k = 0; k < num_rows(); ++k) drift_clock_[k] -= start.at(recording_.run(k));
  duration_ = drift_clock_.maxCoeff();
}

}  // namespace dhcal
