// Least squares through a singular value decomposition with small singular values set to zero:
// the step of English et al. (2004), eqs. (5), (7), (8).
#ifndef DHCAL_CORE_MATH_TRUNCATED_SVD_H_
#define DHCAL_CORE_MATH_TRUNCATED_SVD_H_

#include <Eigen/Core>

namespace dhcal {

/// A = U diag(s) V' with the columns of A scaled beforehand: A = J diag(scale).
struct TruncatedSvd {
  Eigen::MatrixXd U;      // rows x k
  Eigen::VectorXd s;      // k singular values, descending
  Eigen::MatrixXd V;      // cols x k
  Eigen::VectorXd scale;  // cols
  double cut = 0;         // s_i <= cut counts as zero
  int rank = 0;           // number of s_i > cut

  /// Minimum-norm (in scaled columns) x of min ||J x - b|| over the directions kept.
  Eigen::VectorXd Solve(const Eigen::VectorXd& b) const;

  auto kept() const { return V.leftCols(rank); }
  auto dropped() const { return V.rightCols(V.cols() - rank); }
};

/// Decomposes J diag(scale), J with at least as many rows as columns (the R of a QR, say);
/// `cut` is applied later by SetCut.
TruncatedSvd DecomposeScaled(const Eigen::MatrixXd& J, const Eigen::VectorXd& scale);

/// Sets the cut and counts the rank.
void SetCut(double cut, TruncatedSvd* svd);

}  // namespace dhcal

#endif  // DHCAL_CORE_MATH_TRUNCATED_SVD_H_
