#include "problems/diagnosis/projection.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "core/math/statistics.h"
#include "core/math/tsqr.h"

namespace dhcal {
namespace {

constexpr double kZeroColumn = 1e-7;  // of the longest column
// A reading met to a tenth of its noise is no outlier, however well the others are met.
constexpr double kWithinNoise = 0.1;
constexpr double kOutlier = 6.8e-6;  // probability per coordinate: 4.5 standard deviations

/// Left singular vectors of A above a cut, through a QR.
Eigen::MatrixXd Basis(const Eigen::MatrixXd& A, double cut, bool relative) {
  if (A.cols() == 0) return Eigen::MatrixXd(A.rows(), 0);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  const Eigen::MatrixXd R =
      qr.matrixQR().topRows(std::min(A.cols(), A.rows())).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(R, Eigen::ComputeThinU);
  const double above = relative ? cut * svd.singularValues()[0] : cut;
  Eigen::Index rank = 0;
  while (rank < svd.singularValues().size() && svd.singularValues()[rank] > above) ++rank;
  Eigen::MatrixXd U = Eigen::MatrixXd::Zero(A.rows(), rank);
  U.topRows(svd.matrixU().rows()) = svd.matrixU().leftCols(rank);
  U.applyOnTheLeft(qr.householderQ());
  return U;
}

double MedianChiSquare(int dof) { return dof == 1 ? 0.4549 : dof == 2 ? 1.3863 : 2.3660; }

/// Squared length of a reading's residual in standard deviations of what the projection leaves to
/// it. Does not depend on the axes along which the coordinates are counted.
double StandardisedSquare(const Eigen::VectorXd& y,
                          const Eigen::MatrixXd& U,
                          const Eigen::VectorXd& leverage,
                          Eigen::Index first,
                          int count) {
  constexpr double kLeastFree = 1e-3;
  const Eigen::MatrixXd own = U.middleRows(first, count);
  Eigen::MatrixXd free = Eigen::MatrixXd::Identity(count, count) - own * own.transpose();
  if (leverage.size() > 0) free.diagonal() -= leverage.segment(first, count);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(free);
  const Eigen::VectorXd along = eigen.eigenvectors().transpose() * y.segment(first, count);
  return along.cwiseAbs2().cwiseQuotient(eigen.eigenvalues().cwiseMax(kLeastFree)).sum();
}

}  // namespace

Eigen::MatrixXd OrthonormalBasis(const Eigen::MatrixXd& J, double relative_cut) {
  const Eigen::VectorXd norms = J.colwise().norm();
  const double longest = norms.size() > 0 ? norms.maxCoeff() : 0;
  std::vector<int> used;
  for (Eigen::Index k = 0; k < norms.size(); ++k) {
    if (norms[k] > kZeroColumn * longest) used.push_back(static_cast<int>(k));
  }
  if (used.empty()) return Eigen::MatrixXd(J.rows(), 0);
  const Eigen::MatrixXd scaled = J(Eigen::all, used) * norms(used).cwiseInverse().asDiagonal();
  return Basis(scaled, relative_cut, /*relative=*/true);
}

Eigen::MatrixXd BasisAbove(const Eigen::MatrixXd& A, double cut) {
  return Basis(A, cut, /*relative=*/false);
}

std::vector<bool> FlagOutliers(const Eigen::VectorXd& y,
                               const Eigen::MatrixXd& U,
                               int coordinates,
                               const OutlierRule& rule) {
  const auto num_readings = static_cast<std::size_t>(y.size() / coordinates);
  std::vector<bool> flagged(num_readings, false);
  // The three coordinates of a position, or of a rotation, go together.
  const int together = std::min(coordinates, 3);
  std::vector<double> squares;
  for (Eigen::Index first = 0; first < y.size(); first += together) {
    squares.push_back(StandardisedSquare(y, U, rule.leverage, first, together));
  }
  const double scale = Median(squares) / MedianChiSquare(together);
  if (!(scale > 0)) return flagged;
  for (std::size_t k = 0; k < squares.size(); ++k) {
    if (squares[k] < kWithinNoise * kWithinNoise) continue;
    if (ChiSquareTail(squares[k] / scale, together) > together * kOutlier) continue;
    flagged[k * static_cast<std::size_t>(together) / static_cast<std::size_t>(coordinates)] = true;
  }
  const auto count = std::count(flagged.begin(), flagged.end(), true);
  if (static_cast<double>(count) > rule.most * static_cast<double>(num_readings)) {
    flagged.assign(num_readings, false);
  }
  return flagged;
}

bool FollowAJoint(const DesignRows& rows,
                  const Eigen::VectorXd& y,
                  const std::vector<bool>& flagged,
                  int num_joints) {
  constexpr double kChance = 3.7;  // standard deviations, over all joints
  constexpr int kFewest = 4;
  const int coordinates = rows.coordinates();
  const auto count = static_cast<int>(std::count(flagged.begin(), flagged.end(), true));
  if (coordinates < 3 || count < kFewest) return false;
  for (int joint = 0; joint < num_joints; ++joint) {
    const int slot = SlotLayout::kPerJoint * joint;  // theta
    double sum = 0;
    for (std::size_t k = 0; k < flagged.size(); ++k) {
      if (!flagged[k]) continue;
      const auto first = static_cast<Eigen::Index>(k) * coordinates;
      const Eigen::Vector3d r = y.segment<3>(first);
      const Eigen::Vector3d z = rows.now().col(slot).segment<3>(first);
      const double lengths = r.squaredNorm() * z.squaredNorm();
      if (lengths > 0) sum += r.dot(z) * r.dot(z) / lengths;
    }
    const double mean = sum / count;
    if ((mean - 1.0 / 3) / std::sqrt(4.0 / 45 / count) > kChance) return true;
  }
  return false;
}

}  // namespace dhcal
