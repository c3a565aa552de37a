// Products of tall matrices (many rows, tens to thousands of columns) by the SIMD kernels, on all
// processors. The same bits on every SIMD level and for any number of threads.
#ifndef DHCAL_CORE_MATH_PRODUCTS_H_
#define DHCAL_CORE_MATH_PRODUCTS_H_

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "core/simd/kernels.h"
#include "core/simd/level.h"

namespace dhcal {

/// A'B; A and B have as many rows.
Eigen::MatrixXd TransposedProduct(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                  const Eigen::Ref<const Eigen::MatrixXd>& B,
                                  const simd::Kernels& kernels = simd::ActiveKernels());

/// A'A.
Eigen::MatrixXd SquareOf(const Eigen::Ref<const Eigen::MatrixXd>& A,
                         const simd::Kernels& kernels = simd::ActiveKernels());

/// B - A C; A as tall as B, C as wide.
Eigen::MatrixXd Deducted(Eigen::MatrixXd B,
                         const Eigen::Ref<const Eigen::MatrixXd>& A,
                         const Eigen::Ref<const Eigen::MatrixXd>& C,
                         const simd::Kernels& kernels = simd::ActiveKernels());

/// A C; A tall.
Eigen::MatrixXd TallProduct(const Eigen::Ref<const Eigen::MatrixXd>& A,
                            const Eigen::Ref<const Eigen::MatrixXd>& C,
                            const simd::Kernels& kernels = simd::ActiveKernels());

/// U^-1 of a Cholesky factor U'U.
Eigen::MatrixXd InverseRoot(const Eigen::LLT<Eigen::MatrixXd>& factor);

/// U^-T B, U'U a Cholesky factor.
Eigen::MatrixXd DividedByRoot(const Eigen::LLT<Eigen::MatrixXd>& factor,
                              const Eigen::Ref<const Eigen::MatrixXd>& B,
                              const simd::Kernels& kernels = simd::ActiveKernels());

/// Q of A = Q R, R an upper triangle with a positive diagonal: Cholesky QR, three times
/// (Yamamoto et al., "Roundoff error analysis of the CholeskyQR2 algorithm", ETNA 44 (2015);
/// Fukaya et al., SIAM J. Sci. Comput. 42 (2020) for the shift). The columns of A must be
/// independent and of length about 1; with less than 1e-11 of one of them beside the others it
/// comes out as some direction of no meaning, orthogonal to the rest.
Eigen::MatrixXd OrthonormalColumns(Eigen::MatrixXd A,
                                   const simd::Kernels& kernels = simd::ActiveKernels());

}  // namespace dhcal

#endif  // DHCAL_CORE_MATH_PRODUCTS_H_
