#include "problems/diagnosis/projection.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "core/math/statistics.h"
#include "core/math/tsqr.h"

namespace dhcal {
namespace {

constexpr double kZeroColumn = 1e-7;  // of the longest column

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

Eigen::VectorXd ColumnLengths(const Eigen::MatrixXd& B) {
  Eigen::VectorXd lengths = B.colwise().norm().transpose();
  for (double& length : lengths) length = length > 0 ? length : 1.0;
  return lengths;
}

Eigen::MatrixXd ThinBasis(const Eigen::MatrixXd& B) {
  const Eigen::MatrixXd scaled = B * ColumnLengths(B).cwiseInverse().asDiagonal();
  return Eigen::HouseholderQR<Eigen::MatrixXd>(scaled).householderQ() *
         Eigen::MatrixXd::Identity(B.rows(), B.cols());
}

Eigen::MatrixXd GramOf(const Eigen::MatrixXd& B) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(B.cols(), B.cols());
  H.selfadjointView<Eigen::Lower>().rankUpdate(B.transpose());
  return H.selfadjointView<Eigen::Lower>();
}

}  // namespace dhcal
