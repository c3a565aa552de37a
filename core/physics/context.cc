#include "core/physics/context.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <glog/logging.h>

namespace dhcal {

PhysicsContext::PhysicsContext(const RobotModel& robot,
                               const Recording& recording,
                               std::vector<Eigen::Isometry3d> X_WB)
    : robot_(robot), recording_(recording), chain_(robot), X_WB_(std::move(X_WB)) {
  CHECK(!X_WB_.empty());
  frames_.reserve(static_cast<std::size_t>(num_rows()) *
                  static_cast<std::size_t>(num_joints() + 1));
  for (int k = 0; k < num_rows(); ++k) {
    const auto frames = chain_.LinkFrames(recording_.q.row(k).transpose());
    frames_.insert(frames_.end(), frames.begin(), frames.end());
  }
  FillDirections();
  FillClock();
}

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
  FillDirections();
  FillClock();
}

PhysicsContext::PhysicsContext(const PhysicsContext& other, const RobotModel& with_masses)
    : robot_(with_masses),
      recording_(other.recording_),
      chain_(other.chain_),
      X_WB_(other.X_WB_),
      frames_(other.frames_),
      direction_(other.direction_),
      clock_(other.clock_),
      drift_clock_(other.drift_clock_),
      has_one_clock_(other.has_one_clock_),
      duration_(other.duration_) {}

Eigen::Vector3d PhysicsContext::p_WQ(int row_idx) const {
  if (recording_.p_WQ.rows() > 0 && recording_.p_WQ.row(row_idx).allFinite()) {
    return recording_.p_WQ.row(row_idx).transpose();
  }
  return nominal_p_WQ(row_idx);
}

Eigen::Vector3d PhysicsContext::nominal_p_WQ(int row_idx) const {
  return X_WB(row_idx) * (X_BL(row_idx, num_joints() - 1) * robot_.X_TQ.translation());
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

void PhysicsContext::FillDirections() {
  direction_.setZero(num_rows(), num_joints());
  std::vector<int> last(recording_.run_names.empty() ? 1 : recording_.run_names.size(), -1);
  for (int k = 0; k < num_rows(); ++k) {
    int& before = last[static_cast<std::size_t>(recording_.run(k))];
    for (int j = 0; j < num_joints(); ++j) {
      const bool given =
          recording_.direction.rows() > 0 && std::isfinite(recording_.direction(k, j));
      if (given) {
        direction_(k, j) = sign(j) * recording_.direction(k, j);
      } else if (before >= 0) {
        // A joint that stood still keeps the flank on which it came to rest.
        const double step = recording_.q(k, j) - recording_.q(before, j);
        direction_(k, j) = step > 0 ? sign(j) : step < 0 ? -sign(j) : direction_(before, j);
      }
    }
    before = k;
  }
}

void PhysicsContext::FillClock() {
  clock_ = Eigen::VectorXd::LinSpaced(num_rows(), 0, num_rows() - 1);
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
