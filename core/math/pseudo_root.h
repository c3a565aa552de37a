// A root of a symmetric matrix's pseudo-inverse: what conditions a Gram matrix on some columns.
#ifndef DHCAL_CORE_MATH_PSEUDO_ROOT_H_
#define DHCAL_CORE_MATH_PSEUDO_ROOT_H_

#include <Eigen/Core>

namespace dhcal {

/// E (n x rank) with E E' a generalised inverse of the positive semi-definite `S` (n x n): E' S E
/// is the identity. `norm2` (n) are the squared lengths that the columns had before anything was
/// projected out of them; a direction of which less than a millionth of that (squared) is left
/// cannot be told from what was projected out and is not used (PHYSICS.md M1). Up to 60 columns by
/// eigenvalues (then E E' is the scaled matrix's pseudo-inverse), above by a pivoted Cholesky
/// factor.
Eigen::MatrixXd PseudoRoot(const Eigen::MatrixXd& S, const Eigen::VectorXd& norm2);

}  // namespace dhcal

#endif  // DHCAL_CORE_MATH_PSEUDO_ROOT_H_
