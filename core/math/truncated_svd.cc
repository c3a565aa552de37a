#include "core/math/truncated_svd.h"

#include <Eigen/SVD>
#include <glog/logging.h>

namespace dhcal {
namespace {

constexpr Eigen::Index kMany = 160;  // columns

template <typename Svd>
TruncatedSvd Kept(const Svd& svd, const Eigen::VectorXd& scale) {
  TruncatedSvd result;
  result.U = svd.matrixU();
  result.s = svd.singularValues();
  result.V = svd.matrixV();
  result.scale = scale;
  SetCut(0.0, &result);
  return result;
}

}  // namespace

TruncatedSvd DecomposeScaled(const Eigen::MatrixXd& J, const Eigen::VectorXd& scale) {
  CHECK_EQ(J.cols(), scale.size());
  CHECK_GE(J.rows(), J.cols());
  const Eigen::MatrixXd scaled = J * scale.asDiagonal();
  constexpr unsigned int kThin = Eigen::ComputeThinU | Eigen::ComputeThinV;
  // Jacobi rotations: the small singular values decide the rank and must be accurate. Of hundreds
  // of columns (runs, curves) they take seconds, and divide and conquer is accurate to rounding of
  // the largest value, which the rows themselves are no better than.
  if (J.cols() >= kMany) {
    TruncatedSvd divided = Kept(Eigen::BDCSVD<Eigen::MatrixXd>(scaled, kThin), scale);
    // Eigen 3.4's divides by zero, or reads behind an end, for some matrices with many columns that
    // are zero but for rounding: hence the high bound.
    if (divided.U.allFinite() && divided.s.allFinite() && divided.V.allFinite()) return divided;
  }
  return Kept(Eigen::JacobiSVD<Eigen::MatrixXd>(scaled, kThin), scale);
}

void SetCut(double cut, TruncatedSvd* svd) {
  svd->cut = cut;
  svd->rank = static_cast<int>((svd->s.array() > cut).count());
}

Eigen::VectorXd TruncatedSvd::Solve(const Eigen::VectorXd& b) const {
  const Eigen::VectorXd along = (U.leftCols(rank).transpose() * b).cwiseQuotient(s.head(rank));
  return scale.cwiseProduct(V.leftCols(rank) * along);
}

}  // namespace dhcal
