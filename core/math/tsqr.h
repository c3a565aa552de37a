// Tall-skinny QR: reduces any number of rows to an upper triangle, block by block.
#ifndef DHCAL_CORE_MATH_TSQR_H_
#define DHCAL_CORE_MATH_TSQR_H_

#include <Eigen/Core>

namespace dhcal {

/// Accumulates rows of a matrix A and keeps only R with R'R = A'A (Householder, no Gram matrix,
/// so that no digits are lost). Memory: a few hundred rows, however many are added.
class Tsqr {
 public:
  explicit Tsqr(int num_cols);

  /// Appends rows, `rows` is r x num_cols.
  void Add(const Eigen::Ref<const Eigen::MatrixXd>& rows);

  /// num_cols x num_cols upper triangle (rows of zeros when fewer rows were added).
  const Eigen::MatrixXd& R();

  int num_rows() const { return num_rows_; }
  int num_cols() const { return num_cols_; }

 private:
  void Reduce();

  int num_cols_;
  int num_rows_ = 0;
  int filled_ = 0;          // rows of buffer_ in use
  Eigen::MatrixXd buffer_;  // [R; new rows]
  Eigen::MatrixXd r_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MATH_TSQR_H_
