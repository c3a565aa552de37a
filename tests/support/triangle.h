// Triangles of QR factorisations, made comparable.
#ifndef DHCAL_TESTS_SUPPORT_TRIANGLE_H_
#define DHCAL_TESTS_SUPPORT_TRIANGLE_H_

#include <Eigen/Core>

namespace dhcal {

/// Rows turned so that the diagonal is not negative: R is unique up to these signs.
inline Eigen::MatrixXd WithPositiveDiagonal(Eigen::MatrixXd R) {
  for (Eigen::Index k = 0; k < R.rows(); ++k) {
    if (R(k, k) < 0) R.row(k) *= -1;
  }
  return R;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_TRIANGLE_H_
