#include "problems/plan/exchange.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

namespace dhcal {
namespace {

constexpr int kMostSweeps = 20;
// A gain below this share of the criterion (of one unit of log det) is rounding.
constexpr double kGain = 1e-6;

}  // namespace

Exchange::Exchange(const std::vector<Eigen::MatrixXd>& blocks,
                   DesignCriterion criterion,
                   const Eigen::MatrixXd& weights)
    : blocks_(blocks), criterion_(criterion), weights_(weights), taken_(blocks.size(), false) {
  Recompute();
}

void Exchange::Choose(int count) {
  while (static_cast<int>(chosen_.size()) > count) Remove(chosen_.size() - 1);
  while (static_cast<int>(chosen_.size()) < count) {
    const int best = BestFree();
    if (best < 0) break;
    Add(best);
  }
  for (int sweep = 0; sweep < kMostSweeps && Improve(); ++sweep) {
  }
  Recompute();
}

double Exchange::GainOf(int candidate) const {
  const Eigen::MatrixXd& A = blocks_[static_cast<std::size_t>(candidate)];
  if (A.rows() == 0) return 0;
  const Eigen::MatrixXd S = Eigen::MatrixXd::Identity(A.rows(), A.rows()) + A * V_ * A.transpose();
  const Eigen::LLT<Eigen::MatrixXd> llt(S);
  if (criterion_ == DesignCriterion::kD) {
    return 2 * Eigen::MatrixXd(llt.matrixL()).diagonal().array().log().sum();
  }
  return llt.solve(A * VWV_ * A.transpose()).trace();
}

int Exchange::BestFree() const {
  int best = -1;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (taken_[k]) continue;
    const double gain = GainOf(static_cast<int>(k));
    if (gain > most) {
      most = gain;
      best = static_cast<int>(k);
    }
  }
  return best;
}

void Exchange::Add(int candidate) {
  const Eigen::MatrixXd& A = blocks_[static_cast<std::size_t>(candidate)];
  const Eigen::MatrixXd S = Eigen::MatrixXd::Identity(A.rows(), A.rows()) + A * V_ * A.transpose();
  const Eigen::MatrixXd AV = A * V_;
  V_ -= AV.transpose() * S.llt().solve(AV);
  if (criterion_ == DesignCriterion::kI) VWV_ = V_ * weights_ * V_;
  chosen_.push_back(candidate);
  taken_[static_cast<std::size_t>(candidate)] = true;
}

void Exchange::Remove(std::size_t place) {
  taken_[static_cast<std::size_t>(chosen_[place])] = false;
  chosen_.erase(chosen_.begin() + static_cast<long>(place));
  // Downdates lose digits; as many rows as are left are summed quickly.
  Recompute();
}

bool Exchange::Improve() {
  bool improved = false;
  for (std::size_t turn = 0; turn < chosen_.size(); ++turn) {
    // The first in line gives way and the best goes to its end: every place has its turn.
    const int old = chosen_.front();
    Remove(0);
    const double scale = criterion_ == DesignCriterion::kD ? 1.0 : (weights_ * V_).trace();
    const int best = BestFree();
    if (GainOf(best) > GainOf(old) + kGain * scale) {
      Add(best);
      improved = true;
    } else {
      Add(old);
    }
  }
  return improved;
}

void Exchange::Recompute() {
  const Eigen::Index size = blocks_.empty() ? 0 : blocks_.front().cols();
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(size, size);
  for (const int k : chosen_) {
    const Eigen::MatrixXd& A = blocks_[static_cast<std::size_t>(k)];
    M.noalias() += A.transpose() * A;
  }
  V_ = M.llt().solve(Eigen::MatrixXd::Identity(size, size));
  if (criterion_ == DesignCriterion::kI) VWV_ = V_ * weights_ * V_;
}

}  // namespace dhcal
