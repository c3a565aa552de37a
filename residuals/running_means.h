// Weighted means over the earlier rows of a series: what whitens differences of shared readings.
//
// Adjacent differences d_k = y_k - y_(k-1) of independently read y share each reading, so their
// covariance is tridiagonal. Its exact Cholesky whitening is Helmert's contrast,
//   (y_k - mean(y_0 .. y_(k-1))) / sqrt(sigma_k^2 + 1 / sum_(i<k) sigma_i^-2),
// with the mean weighted by 1/sigma_i^2: the innovation of y_k given the earlier differences. It is
// also what remains of y when each series gets one free offset.
#ifndef DHCAL_RESIDUALS_RUNNING_MEANS_H_
#define DHCAL_RESIDUALS_RUNNING_MEANS_H_

#include <vector>

#include <Eigen/Core>

namespace dhcal {

class RunningMeans {
 public:
  /// Empty: no series, no cost.
  RunningMeans() = default;
  /// `previous[r]` is the row before r in its series, -1 at a start, and below r; `sigma` [m].
  RunningMeans(std::vector<int> previous, Eigen::VectorXd sigma);

  int num_rows() const { return static_cast<int>(previous_.size()); }

  /// Standard deviation [m] of row minus the mean of its predecessors.
  double contrast_sigma(int row_idx) const;

  /// Mean of `values` (3 x rows, say) over the earlier rows of row_idx's series, for all rows;
  /// zero at a start. `stride` columns belong to each row.
  Eigen::Matrix3Xd Means(const Eigen::Matrix3Xd& values, Eigen::Index stride) const;

  void UpdatePositions(const Eigen::Matrix3Xd& p) {
    if (num_rows() > 0) p_mean_ = Means(p, 1);
  }
  void UpdateDerivatives(const Eigen::Matrix3Xd& J, Eigen::Index stride) {
    if (num_rows() > 0) J_mean_ = Means(J, stride);
    stride_ = stride;
  }
  auto p_mean(int row_idx) const { return p_mean_.col(row_idx); }
  auto J_mean(int row_idx, Eigen::Index num_cols) const {
    return J_mean_.middleCols(row_idx * stride_, num_cols);
  }

 private:
  std::vector<int> previous_;
  Eigen::VectorXd sigma_;
  Eigen::VectorXd weight_before_;  // sum of 1/sigma^2 over the earlier rows of the series
  Eigen::Matrix3Xd p_mean_, J_mean_;
  Eigen::Index stride_ = 0;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_RUNNING_MEANS_H_
