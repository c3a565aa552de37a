// Matrices of independent normal numbers.
#ifndef DHCAL_TESTS_SUPPORT_RANDOM_MATRIX_H_
#define DHCAL_TESTS_SUPPORT_RANDOM_MATRIX_H_

#include <Eigen/Core>

#include "core/base/rng.h"

namespace dhcal {

inline Eigen::MatrixXd RandomMatrix(Eigen::Index rows, Eigen::Index cols, Rng* rng) {
  Eigen::MatrixXd A(rows, cols);
  for (double& value : A.reshaped()) value = rng->Normal();
  return A;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_RANDOM_MATRIX_H_
