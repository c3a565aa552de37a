#include "core/math/truncated_svd.h"

#include <Eigen/SVD>
#include <glog/logging.h>

namespace dhcal {

TruncatedSvd DecomposeScaled(const Eigen::MatrixXd& J, const Eigen::VectorXd& scale) {
  CHECK_EQ(J.cols(), scale.size());
  CHECK_GE(J.rows(), J.cols());
  // Jacobi rotations: the small singular values decide the rank and must be accurate.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J * scale.asDiagonal(),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  TruncatedSvd result;
  result.U = svd.matrixU();
  result.s = svd.singularValues();
  result.V = svd.matrixV();
  result.scale = scale;
  SetCut(0.0, &result);
  return result;
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
