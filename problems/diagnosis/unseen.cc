#include "problems/diagnosis/unseen.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/base/rng.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRegions = 5;
constexpr int kRunsEnough = 3;
constexpr int kRounds = 30;

/// Points of joint angles on circles, so that -180 and 180 degrees are near.
MatrixXd JointPoints(const Calibration& c) {
  const int n = c.recording.num_joints();
  MatrixXd points(c.recording.num_rows(), 2 * n);
  for (Index k = 0; k < points.rows(); ++k) {
    for (int j = 0; j < n; ++j) {
      const double q = c.recording.q(k, j);
      points(k, 2 * j) = std::cos(q);
      points(k, 2 * j + 1) = std::sin(q);
    }
  }
  return points;
}

std::vector<int> Nearest(const MatrixXd& points, const MatrixXd& centres) {
  std::vector<int> nearest(static_cast<std::size_t>(points.rows()));
  for (Index k = 0; k < points.rows(); ++k) {
    Index best = 0;
    (centres.rowwise() - points.row(k)).rowwise().squaredNorm().minCoeff(&best);
    nearest[static_cast<std::size_t>(k)] = static_cast<int>(best);
  }
  return nearest;
}

std::vector<int> Regions(const MatrixXd& points) {
  Rng rng(5);
  const auto count = std::min<Index>(kRegions, points.rows());
  MatrixXd centres(count, points.cols());
  for (Index k = 0; k < count; ++k) {
    centres.row(k) =
        points.row(static_cast<Index>(rng.Uniform(0, 1) * static_cast<double>(points.rows())));
  }
  std::vector<int> region;
  for (int round = 0; round < kRounds; ++round) {
    region = Nearest(points, centres);
    MatrixXd sums = MatrixXd::Zero(count, points.cols());
    VectorXd members = VectorXd::Zero(count);
    for (Index k = 0; k < points.rows(); ++k) {
      const int r = region[static_cast<std::size_t>(k)];
      sums.row(r) += points.row(k);
      members[r] += 1;
    }
    for (Index r = 0; r < count; ++r) {
      if (members[r] > 0) centres.row(r) = sums.row(r) / members[r];
    }
  }
  return region;
}

}  // namespace

Folds MakeFolds(const Calibration& c) {
  Folds folds;
  const auto num_runs = static_cast<int>(c.recording.run_names.size());
  if (num_runs >= kRunsEnough && !c.spec.robot.base_per_run && !c.spec.robot.tool_per_run) {
    folds.method = "runs left out";
    for (int row = 0; row < c.recording.num_rows(); ++row) {
      folds.of_row.push_back(c.recording.run(row) % 10);
    }
  } else {
    folds.method = "regions left out";
    folds.of_row = Regions(JointPoints(c));
  }
  for (const int fold : folds.of_row) folds.count = std::max(folds.count, fold + 1);
  return folds;
}

LeftOutRows::LeftOutRows(const CompleteFit& fit, const Folds& folds)
    : model_(fit.calibration, fit.state(), fit.fit.noise_seen),
      rows_(static_cast<std::size_t>(folds.count)) {
  const Calibration& c = fit.calibration;
  unknown_of_effect_.resize(c.effect_columns.size());
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const int column = c.parameters[k].effect_column;
    if (column >= 0) unknown_of_effect_[static_cast<std::size_t>(column)] = static_cast<int>(k);
  }
  for (std::size_t k = 0; k < model_.recording_row.size(); ++k) {
    const int fold = folds.of_row[static_cast<std::size_t>(model_.recording_row[k])];
    rows_[static_cast<std::size_t>(fold)].push_back(static_cast<int>(k));
  }
  const Index size = model_.A.cols();
  all_ = {MatrixXd::Zero(size, size), VectorXd::Zero(size)};
  for (const std::vector<int>& rows : rows_) {
    folds_.push_back(rows.empty()
                         ? NormalEquations{MatrixXd::Zero(size, size), VectorXd::Zero(size)}
                         : NormalEquationsOf(model_, rows));
    all_.H += folds_.back().H;
    all_.b += folds_.back().b;
    fold_squares_.push_back(model_.y(rows).squaredNorm());
  }
}

bool LeftOutRows::IsPredicted(std::size_t fold) const {
  return !rows_[fold].empty() && rows_[fold].size() < model_.recording_row.size();
}

double LeftOutRows::Squares(const std::vector<int>& dropped) const {
  if (covariances_.empty()) {
    for (const NormalEquations& fold : folds_) covariances_.push_back(Covariance(all_.H - fold.H));
  }
  std::vector<int> unknowns;
  for (const int k : dropped) unknowns.push_back(unknown_of_effect_[static_cast<std::size_t>(k)]);
  double squares = 0;
  for (std::size_t fold = 0; fold < folds_.size(); ++fold) {
    if (!IsPredicted(fold)) continue;
    const MatrixXd& P = covariances_[fold];
    VectorXd x = P * (all_.b - folds_[fold].b);
    if (!unknowns.empty()) {
      // The solution under the condition that the dropped unknowns are zero.
      const MatrixXd P_dropped = P(unknowns, unknowns);
      const VectorXd x_dropped = x(unknowns);
      x -= P(Eigen::all, unknowns) * Eigen::LLT<MatrixXd>(P_dropped).solve(x_dropped);
    }
    squares += fold_squares_[fold] - 2 * folds_[fold].b.dot(x) + x.dot(folds_[fold].H * x);
  }
  return squares;
}

std::vector<int> LeftOutRows::Kept(const std::vector<int>& dropped) const {
  std::vector<bool> is_dropped(static_cast<std::size_t>(model_.A.cols()), false);
  for (const int column : dropped) {
    const int unknown = unknown_of_effect_[static_cast<std::size_t>(column)];
    is_dropped[static_cast<std::size_t>(unknown)] = true;
  }
  std::vector<int> kept;
  for (std::size_t k = 0; k < is_dropped.size(); ++k) {
    if (!is_dropped[k]) kept.push_back(static_cast<int>(k));
  }
  return kept;
}

VectorXd LeftOutRows::Residuals(const std::vector<int>& dropped) const {
  const std::vector<int> kept = Kept(dropped);
  VectorXd residuals = VectorXd::Zero(model_.y.size());
  for (std::size_t fold = 0; fold < folds_.size(); ++fold) {
    const std::vector<int>& out = rows_[fold];
    if (!IsPredicted(fold)) continue;
    const VectorXd x = Solve({all_.H - folds_[fold].H, all_.b - folds_[fold].b}, kept);
    // All rows' products at once: one row of a matrix stored by columns costs as much as eight.
    const VectorXd left = model_.y - model_.A * x;
    residuals(out) = left(out);
  }
  return residuals;
}

VectorXd LeftOutRows::Fitted(const std::vector<int>& dropped) const {
  return model_.y - model_.A * Solve(all_, Kept(dropped));
}

}  // namespace dhcal
