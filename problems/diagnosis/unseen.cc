#include "problems/diagnosis/unseen.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>
#include <Eigen/SVD>

#include "core/base/rng.h"
#include "core/math/tsqr.h"
#include "problems/assembly.h"
#include "problems/diagnosis/design_rows.h"

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

/// The fit's rows in units of the tolerances, and what they leave.
struct LinearModel {
  MatrixXd A;  // rows x unknowns, times tolerance
  VectorXd y;
  std::vector<int> recording_row;  // of each row
};

LinearModel Linear(const CompleteFit& fit, const std::vector<int>& dropped) {
  const Calibration& c = fit.calibration;
  const DesignRows rows(c, fit.state(), fit.fit.noise_seen, c.readings.fitted);
  LinearModel model;
  model.recording_row = rows.now_row();
  model.y = rows.y();
  const VectorXd tolerance = ScalesOf(c.parameters).tolerance;
  const MatrixXd J = rows.Geometry(c.parameters);
  std::vector<Index> kept;
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const int column = c.parameters[k].effect_column;
    const auto i = static_cast<Index>(k);
    if (column >= 0 && std::find(dropped.begin(), dropped.end(), column) != dropped.end()) {
      model.y += J.col(i) * fit.state()[i];
    } else {
      kept.push_back(i);
    }
  }
  model.A.resize(J.rows(), static_cast<Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    model.A.col(static_cast<Index>(k)) = J.col(kept[k]) * tolerance[kept[k]];
  }
  return model;
}

VectorXd Solve(const MatrixXd& A, const VectorXd& y) {
  Tsqr tsqr(static_cast<int>(A.cols()) + 1);
  MatrixXd rows(A.rows(), A.cols() + 1);
  rows << A, y;
  tsqr.Add(rows);
  const MatrixXd& R = tsqr.R();
  const Index n = A.cols();
  const Eigen::JacobiSVD<MatrixXd> svd(R.topLeftCorner(n, n),
                                       Eigen::ComputeThinU | Eigen::ComputeThinV);
  const VectorXd b = svd.matrixU().transpose() * R.col(n).head(n);
  VectorXd x = VectorXd::Zero(n);
  for (Index k = 0; k < n; ++k) {
    const double s = svd.singularValues()[k];
    if (s > 1) x += svd.matrixV().col(k) * (b[k] / s);
  }
  return x;
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

VectorXd LeftOutResiduals(const CompleteFit& fit,
                          const Folds& folds,
                          const std::vector<int>& dropped) {
  const LinearModel model = Linear(fit, dropped);
  VectorXd residuals = VectorXd::Zero(model.y.size());
  for (int fold = 0; fold < folds.count; ++fold) {
    std::vector<int> in, out;
    for (Index k = 0; k < model.y.size(); ++k) {
      const auto row = static_cast<std::size_t>(model.recording_row[static_cast<std::size_t>(k)]);
      (folds.of_row[row] == fold ? out : in).push_back(static_cast<int>(k));
    }
    if (out.empty() || in.empty()) continue;
    const MatrixXd A_in = model.A(in, Eigen::all), A_out = model.A(out, Eigen::all);
    const VectorXd x = Solve(A_in, model.y(in));
    const VectorXd left = model.y(out) - A_out * x;
    for (std::size_t k = 0; k < out.size(); ++k) residuals[out[k]] = left[static_cast<Index>(k)];
  }
  return residuals;
}

VectorXd FittedResiduals(const CompleteFit& fit, const std::vector<int>& dropped) {
  const LinearModel model = Linear(fit, dropped);
  return model.y - model.A * Solve(model.A, model.y);
}

}  // namespace dhcal
