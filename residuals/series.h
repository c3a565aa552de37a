// Whitening of pairs that share a pose's reading error: what makes them independent again.
//
// Adjacent differences d_k = y_k - y_(k-1) of independently read y share each reading, so their
// covariance is tridiagonal. With e_k the error of pose k up to an offset of its series (the sum of
// the pairs' differences so far), its exact Cholesky whitening is Helmert's contrast,
//   (e_k - mean(e_0 .. e_(k-1))) / sqrt(sigma_k^2 + 1 / sum_(i<k) sigma_i^-2),
// with the mean weighted by 1/sigma_i^2: the innovation of y_k given the earlier differences. It is
// also what remains of y when each series gets one free offset.
//
// Where the first pose is anchored (its position is read, too) there is no offset: the innovation
// is e_k / sigma_k itself, the row of an absolute position reading.
#ifndef DHCAL_RESIDUALS_SERIES_H_
#define DHCAL_RESIDUALS_SERIES_H_

#include <Eigen/Core>

namespace dhcal {

/// Whitens the rows [J, r] of a series' pairs one after the other, in order.
class SeriesWhitener {
 public:
  /// A series with a free offset, whose first pose was read to `sigma_first` [m]. Rows have
  /// `num_cols` columns, `num_coordinates` rows each.
  SeriesWhitener(int num_coordinates, int num_cols, double sigma_first);
  /// A series whose first pose is anchored: its rows come first, as a reading by itself.
  SeriesWhitener(int num_coordinates, int num_cols);

  /// `rows` of the next pair, predicted minus measured, in metres; replaced by whitened ones.
  /// `sigma` [m]: of the pose that the pair adds.
  void Whiten(double sigma, Eigen::Ref<Eigen::MatrixXd> rows);

 private:
  bool free_offset_;
  Eigen::MatrixXd error_;     // e_(k-1)
  Eigen::MatrixXd mean_;      // of e_0 .. e_(k-1)
  double weight_before_ = 0;  // sum of 1/sigma^2 over them [1/m^2]
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_SERIES_H_
