#include "residuals/pose_cache.h"

#include <algorithm>
#include <utility>

#include <glog/logging.h>

namespace dhcal {

PoseCache::PoseCache(const DhChain* chain,
                     std::vector<Scope> scopes,
                     std::vector<CacheRow> rows,
                     const std::vector<double>* state,
                     bool with_orientation)
    : chain_(chain),
      scopes_(std::move(scopes)),
      rows_(std::move(rows)),
      state_(state),
      with_orientation_(with_orientation) {
  for (const Scope& scope : scopes_) {
    CHECK_EQ(scope.parameters.size(), scope.slots.size());
    stride_ = std::max(stride_, static_cast<Eigen::Index>(scope.parameters.size()));
  }
  const auto num_rows = static_cast<Eigen::Index>(rows_.size());
  p_WQ_.resize(3, num_rows);
  if (with_orientation_) R_WQ_.resize(rows_.size());
}

void PoseCache::EnableRunningMeans(RunningMeans means) {
  CHECK_EQ(means.num_rows(), num_rows());
  means_ = std::move(means);
}

void PoseCache::PrepareForEvaluation(bool evaluate_jacobians, bool /*new_evaluation_point*/) {
  // Ceres announces a new point also when it evaluates the same one again (in chunks of blocks,
  // for a covariance); comparing the few numbers of the state is the safe test.
  if (*state_ == state_of_derivatives_) return;
  if (evaluate_jacobians) {
    ComputeWithDerivatives();
    state_of_derivatives_ = state_of_poses_ = *state_;
  } else if (*state_ != state_of_poses_) {
    ComputePositions();
    state_of_poses_ = *state_;
    // The positions that belonged to the derivatives have been overwritten.
    state_of_derivatives_.clear();
  }
}

Eigen::VectorXd PoseCache::SlotDeltas(const Scope& scope) const {
  Eigen::VectorXd delta = Eigen::VectorXd::Zero(chain_->slots().size());
  for (std::size_t k = 0; k < scope.slots.size(); ++k) {
    if (scope.slots[k] < 0) continue;
    delta[scope.slots[k]] += (*state_)[static_cast<std::size_t>(scope.parameters[k])];
  }
  return delta;
}

Eigen::VectorXd PoseCache::RowDeltas(const CacheRow& row, const Eigen::VectorXd& of_scope) const {
  Eigen::VectorXd delta = of_scope;
  for (const HeldTerm& term : row.held) delta[term.slot] += term.amount;
  const Scope& scope = scopes_[static_cast<std::size_t>(row.scope)];
  for (const EffectTerm& term : row.effects) {
    const int parameter = scope.parameters[static_cast<std::size_t>(term.column)];
    delta[term.slot] += term.weight * (*state_)[static_cast<std::size_t>(parameter)];
  }
  return delta;
}

void PoseCache::FillColumns(const PoseWithDerivatives& pose, int row_idx) {
  const Scope& of_row = scope(row_idx);
  const Eigen::Index first = row_idx * stride_;
  for (std::size_t k = 0; k < of_row.slots.size(); ++k) {
    const Eigen::Index col = first + static_cast<Eigen::Index>(k);
    const int slot = of_row.slots[k];
    if (slot < 0) {
      J_p_.col(col).setZero();
      if (with_orientation_) J_w_.col(col).setZero();
      continue;
    }
    J_p_.col(col) = pose.J_p.col(slot);
    if (with_orientation_) J_w_.col(col) = pose.J_w.col(slot);
  }
  for (const EffectTerm& term : rows_[static_cast<std::size_t>(row_idx)].effects) {
    J_p_.col(first + term.column) += term.weight * pose.J_p.col(term.slot);
    if (with_orientation_) J_w_.col(first + term.column) += term.weight * pose.J_w.col(term.slot);
  }
}

void PoseCache::ComputePositions() {
  std::vector<Eigen::VectorXd> deltas;
  for (const Scope& scope : scopes_) deltas.push_back(SlotDeltas(scope));
  for (int row_idx = 0; row_idx < num_rows(); ++row_idx) {
    const CacheRow& row = rows_[static_cast<std::size_t>(row_idx)];
    const auto scope_idx = static_cast<std::size_t>(row.scope);
    const Eigen::Isometry3d X_WQ =
        chain_->Pose<double>(row.q, RowDeltas(row, deltas[scope_idx]), scopes_[scope_idx].ends);
    p_WQ_.col(row_idx) = X_WQ.translation();
    if (with_orientation_) R_WQ_[static_cast<std::size_t>(row_idx)] = X_WQ.linear();
  }
  means_.UpdatePositions(p_WQ_);
}

void PoseCache::ComputeWithDerivatives() {
  const Eigen::Index num_cols = stride_ * static_cast<Eigen::Index>(rows_.size());
  if (J_p_.cols() != num_cols) {
    J_p_.setZero(3, num_cols);
    if (with_orientation_) J_w_.setZero(3, num_cols);
  }
  std::vector<Eigen::VectorXd> deltas;
  for (const Scope& scope : scopes_) deltas.push_back(SlotDeltas(scope));
  PoseWithDerivatives pose;
  for (int row_idx = 0; row_idx < num_rows(); ++row_idx) {
    const CacheRow& row = rows_[static_cast<std::size_t>(row_idx)];
    const auto scope_idx = static_cast<std::size_t>(row.scope);
    const Scope& scope = scopes_[scope_idx];
    chain_->PoseAndDerivatives(row.q, RowDeltas(row, deltas[scope_idx]), scope.ends, &pose);
    p_WQ_.col(row_idx) = pose.p_WQ;
    if (with_orientation_) R_WQ_[static_cast<std::size_t>(row_idx)] = pose.R_WQ;
    FillColumns(pose, row_idx);
  }
  means_.UpdatePositions(p_WQ_);
  means_.UpdateDerivatives(J_p_, stride_);
}

}  // namespace dhcal
