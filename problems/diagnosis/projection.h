// Takes out of rows what the geometry can explain.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_PROJECTION_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_PROJECTION_H_

#include <Eigen/Core>

namespace dhcal {

/// Orthonormal basis of the columns of J that are independent to `relative_cut` after scaling the
/// columns to unit length. Columns that are zero but for rounding are dropped first: scaling them
/// up would make directions out of nothing (PHYSICS.md M1).
Eigen::MatrixXd OrthonormalBasis(const Eigen::MatrixXd& J, double relative_cut = 1e-7);

/// Orthonormal basis of all columns, as many as there are; priors' rows make them independent.
Eigen::MatrixXd ThinBasis(const Eigen::MatrixXd& B);

/// Orthonormal basis of what `columns` have beside the orthonormal columns of Q, without directions
/// that they hardly have (1e-4 of their length).
Eigen::MatrixXd OrthonormalBasisBeside(const Eigen::MatrixXd& Q, const Eigen::MatrixXd& columns);

/// Each column's length, to scale by; 1 where it is zero.
Eigen::VectorXd ColumnLengths(const Eigen::MatrixXd& B);

/// v without what lies in the basis.
template <typename Derived>
Eigen::MatrixXd ProjectOff(const Eigen::MatrixXd& U, const Eigen::MatrixBase<Derived>& v) {
  return v - U * (U.transpose() * v);
}

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_PROJECTION_H_
