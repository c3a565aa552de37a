#include "problems/setup/frames_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace dhcal {
namespace {

// A left-handed frame must fit so much better: readings in a plane fit both.
constexpr double kMirrored = 0.5;
// Against p that no reading shows; far below what any shows.
constexpr double kRidge = 1e-10;

// Within so much of 1 a scale is none.
constexpr double kNoScale = 0.1;

/// The nearest scale that wrong units make: 1, or powers of ten of whole thousands and inches.
double ScaleNear(double scale) {
  for (const double inches : {1.0, 25.4, 1 / 25.4}) {
    for (int thousands = -2; thousands <= 2; ++thousands) {
      const double unit = inches * std::pow(1000.0, thousands);
      if (std::abs(scale / unit - 1) < kNoScale) return unit;
    }
  }
  return 1;
}

}  // namespace

FramesFit::FramesFit(const Calibration& c, const std::vector<Reading>& readings)
    : pairs_(c.measurement->kind().pairs),
      distances_(!c.measurement->kind().is_point()),
      tool_(c.frames.tool({}).translation()) {
  const auto n = static_cast<Eigen::Index>(readings.size());
  if (distances_) {
    distance_.resize(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const int row = readings[static_cast<std::size_t>(k)].row_idx;
      distance_[k] = c.recording.distance[row];
      anchor_.push_back(c.recording.anchor_idx.empty()
                            ? 0
                            : c.recording.anchor_idx[static_cast<std::size_t>(row)]);
      num_anchors_ = std::max(num_anchors_, anchor_.back() + 1);
    }
    return;
  }
  y_.resize(3, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    y_.col(k) = c.measurement->Point(readings[static_cast<std::size_t>(k)]);
  }
  const Eigen::Vector3d mean = pairs_ ? Eigen::Vector3d::Zero() : y_.rowwise().mean().eval();
  spread_ = (y_.colwise() - mean) * (y_.colwise() - mean).transpose() / static_cast<double>(n);
  Eigen::MatrixXd basis(n, pairs_ ? 3 : 4);
  basis.leftCols<3>() = y_.transpose();
  if (!pairs_) basis.col(3).setOnes();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis);
  orthonormal_ = qr.householderQ() * Eigen::MatrixXd::Identity(n, basis.cols());
  root_ = qr.matrixQR().topRows(basis.cols()).triangularView<Eigen::Upper>();
}

void FramesFit::JudgeFrame(const Eigen::Matrix3d& C, double rms_t, FramesMisfit* misfit) const {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(C * spread_,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const auto judge = [&](double handedness) {
    const double flip =
        handedness * (svd.matrixU() * svd.matrixV().transpose()).determinant() > 0 ? 1 : -1;
    const Eigen::Matrix3d R =
        svd.matrixU() * Eigen::Vector3d(1, 1, flip).asDiagonal() * svd.matrixV().transpose();
    FramesMisfit judged = *misfit;
    judged.mirrored = handedness < 0;
    judged.scale = ScaleNear((R.transpose() * C * spread_).trace() / spread_.trace());
    const Eigen::Matrix3d rest = C - judged.scale * R;
    const double of_frame = (rest * spread_ * rest.transpose()).trace();
    judged.rms = std::sqrt(rms_t * rms_t + of_frame) / judged.scale;
    return judged;
  };
  *misfit = judge(1);
  const FramesMisfit mirrored = judge(-1);
  if (mirrored.rms < kMirrored * misfit->rms) *misfit = mirrored;
}

FramesMisfit FramesFit::FitPoints(const FlangePoses& now, const FlangePoses& before) const {
  const Eigen::Index n = y_.cols();
  // t and the three columns of R, coordinate by coordinate: n x 12, beside the basis.
  Columns<12> all(n, 12);
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    all.col(k) = now.p[i].matrix();
    if (pairs_) all.col(k) -= before.p[i].matrix();
    for (int c = 0; c < 3; ++c) {
      const auto axis = static_cast<std::size_t>(c);
      all.col(3 + 3 * c + k) = now.R[axis][i].matrix();
      if (pairs_) all.col(3 + 3 * c + k) -= before.R[axis][i].matrix();
    }
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 12, Eigen::ColMajor, 4, 12> in_basis =
      orthonormal_.transpose() * all;
  const Columns<12> beside = all - orthonormal_ * in_basis;
  // Normal equations of p over the three coordinates.
  Eigen::Matrix3d A;
  Eigen::Vector3d b;
  for (int c = 0; c < 3; ++c) {
    const auto axis = beside.middleCols<3>(3 + 3 * c);
    b[c] = -(axis.cwiseProduct(beside.leftCols<3>())).sum();
    for (int e = 0; e <= c; ++e) {
      A(c, e) = A(e, c) = axis.cwiseProduct(beside.middleCols<3>(3 + 3 * e)).sum();
    }
  }
  const double ridge = kRidge * static_cast<double>(n);
  A.diagonal().array() += ridge;
  FramesMisfit misfit;
  misfit.p_TQ = A.ldlt().solve(b);
  Columns<3> rest = beside.leftCols<3>();
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, 4, 3> of_basis = in_basis.leftCols<3>();
  for (int c = 0; c < 3; ++c) {
    rest += misfit.p_TQ[c] * beside.middleCols<3>(3 + 3 * c);
    of_basis += misfit.p_TQ[c] * in_basis.middleCols<3>(3 + 3 * c);
  }
  const Eigen::MatrixXd coefficients = root_.triangularView<Eigen::Upper>().solve(of_basis);
  const double rms_t = std::sqrt(rest.squaredNorm() / static_cast<double>(n));
  JudgeFrame(coefficients.topRows<3>().transpose(), rms_t, &misfit);
  if (!std::isfinite(misfit.rms)) misfit.rms = std::numeric_limits<double>::infinity();
  return misfit;
}

FramesMisfit FramesFit::FitDistances(const FlangePoses& now) const {
  const Eigen::Index n = distance_.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, 4 + 4 * num_anchors_);
  Eigen::VectorXd b(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Matrix3d R;
    Eigen::Vector3d t;
    for (int i = 0; i < 3; ++i) {
      t[i] = now.p[static_cast<std::size_t>(i)][k];
      for (int c = 0; c < 3; ++c) {
        R(i, c) = now.R[static_cast<std::size_t>(c)][static_cast<std::size_t>(i)][k];
      }
    }
    t += R * tool_;
    A(k, 0) = distance_[k] * distance_[k];
    A.block<1, 3>(k, 1) = -2 * t.transpose() * R;
    const int anchor = 4 + 4 * anchor_[static_cast<std::size_t>(k)];
    A.block<1, 3>(k, anchor) = 2 * t.transpose();
    A(k, anchor + 3) = 1;
    b[k] = t.squaredNorm();
  }
  FramesMisfit misfit;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  const Eigen::VectorXd x = qr.solve(b);
  if (!(x[0] > 0)) return misfit;
  misfit.scale = ScaleNear(std::sqrt(x[0]));
  const Eigen::VectorXd rest =
      (b - A * x + (x[0] - misfit.scale * misfit.scale) * A.col(0)).array() /
      (2 * misfit.scale * misfit.scale * distance_.array());
  misfit.p_TQ = tool_ + x.segment<3>(1);
  misfit.rms = std::sqrt(rest.squaredNorm() / static_cast<double>(n));
  if (!std::isfinite(misfit.rms)) misfit.rms = std::numeric_limits<double>::infinity();
  return misfit;
}

FramesMisfit FramesFit::Fit(const FlangePoses& now, const FlangePoses& before) const {
  return distances_ ? FitDistances(now) : FitPoints(now, before);
}

}  // namespace dhcal
