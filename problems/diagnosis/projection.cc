#include "problems/diagnosis/projection.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "core/math/products.h"
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

Eigen::MatrixXd OrthonormalBasisBeside(const Eigen::MatrixXd& Q, const Eigen::MatrixXd& columns) {
  constexpr double kHardly = 1e-8;  // squared
  const Eigen::MatrixXd scaled = columns * ColumnLengths(columns).cwiseInverse().asDiagonal();
  const auto beside = [&](const Eigen::MatrixXd& X) {
    return Deducted(X, Q, TransposedProduct(Q, X));
  };
  const Eigen::MatrixXd left = beside(scaled);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(SquareOf(left));
  Eigen::Index rank = 0;
  while (rank < columns.cols() && eigen.eigenvalues().reverse()[rank] > kHardly) ++rank;
  // The second time takes out what rounding of the first has left along Q.
  return OrthonormalColumns(beside(TallProduct(left, eigen.eigenvectors().rightCols(rank))));
}

Eigen::VectorXd ColumnLengths(const Eigen::MatrixXd& B) {
  Eigen::VectorXd lengths = B.colwise().norm().transpose();
  for (double& length : lengths) length = length > 0 ? length : 1.0;
  return lengths;
}

Eigen::MatrixXd ThinBasis(const Eigen::MatrixXd& B) {
  return OrthonormalColumns(B * ColumnLengths(B).cwiseInverse().asDiagonal());
}

}  // namespace dhcal
