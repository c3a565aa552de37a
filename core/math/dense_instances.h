// Eigen's decompositions of dense matrices, compiled once (dense_instances.cc) and not in each file
// that uses one, where they are up to half of the compiler's work.
//
// The build puts this header in front of all files (tools/cmake/DhcalPrecompile.cmake), so none
// need include it. A file that is compiled without it has copies of its own, to the same effect.
#ifndef DHCAL_CORE_MATH_DENSE_INSTANCES_H_
#define DHCAL_CORE_MATH_DENSE_INSTANCES_H_

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace Eigen {

// A class's instance has all its members but those that are templates themselves: those follow it.
#define DHCAL_DENSE_INSTANCES(TEMPLATE)                                                            \
  TEMPLATE class LLT<MatrixXd>;                                                                    \
  TEMPLATE LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);                      \
  TEMPLATE class LDLT<MatrixXd>;                                                                   \
  TEMPLATE LDLT<MatrixXd>& LDLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);                    \
  TEMPLATE class HouseholderQR<MatrixXd>;                                                          \
  TEMPLATE class ColPivHouseholderQR<MatrixXd>;                                                    \
  TEMPLATE class CompleteOrthogonalDecomposition<MatrixXd>;                                        \
  TEMPLATE void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) \
      const;                                                                                       \
  TEMPLATE class JacobiSVD<MatrixXd>;                                                              \
  TEMPLATE class SelfAdjointEigenSolver<MatrixXd>;                                                 \
  TEMPLATE SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(            \
      const EigenBase<MatrixXd>&, int);

DHCAL_DENSE_INSTANCES(extern template)

}  // namespace Eigen

#endif  // DHCAL_CORE_MATH_DENSE_INSTANCES_H_
