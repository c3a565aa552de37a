// Many rows of [J, -r] reduced to an upper triangle R with R'R = [J, -r]'[J, -r], as Tsqr does, at
// the speed of a Gram matrix.
//
// A Gram matrix of raw rows squares the condition and loses weak directions. Here each row j is
// first divided by the triangle U of the rows before it, t U = j: the rows t are nearly orthonormal
// in number, the Gram matrix of theirs is well conditioned, and R = chol(U-part + T'T) U is as
// exact as Householder's (preconditioned Cholesky QR; Fukaya et al., "Shifted Cholesky QR for
// computing the QR factorization of ill-conditioned matrices", SIAM J. Sci. Comput. 42 (2020)). U
// comes from the first rows by Householder and is renewed each time that the rows have become four
// times as many, and where rows bring a direction that U has not seen: |t| too large sends them to
// Householder, when there are as many of them as columns.
#ifndef DHCAL_CORE_MATH_ROW_REDUCTION_H_
#define DHCAL_CORE_MATH_ROW_REDUCTION_H_

#include <cstddef>
#include <cstdint>
#include <functional>

#include <Eigen/Core>

#include "core/simd/aligned.h"
#include "core/simd/kernels.h"
#include "core/simd/level.h"

namespace dhcal {

/// Rows by columns, column k at `data + k * stride`.
struct RowTile {
  const double* data = nullptr;
  Eigen::Index num_rows = 0;
  std::ptrdiff_t stride = 0;
  const double* weight = nullptr;  // multiplies each row (1 / sigma); null = 1
};

/// The triangle's bits depend on the rows and on how they are cut into tiles, not on the SIMD
/// level.
class RowReduction {
 public:
  explicit RowReduction(int num_cols, const simd::Kernels& kernels = simd::ActiveKernels());

  /// Appends rows. Fastest for tiles at simd::kAlignment, with a stride and rows of its multiples.
  void Add(const RowTile& tile);
  void Add(const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Appends all rows that went into another one.
  void Merge(RowReduction* other);

  /// num_cols x num_cols upper triangle of all rows so far; not-a-number where one of them was.
  const Eigen::MatrixXd& R();

  int num_cols() const { return static_cast<int>(R_.cols()); }
  std::int64_t num_rows() const { return num_rows_; }

 private:
  void AddBlock(const RowTile& rows);
  void AddSample(const Eigen::Ref<const Eigen::MatrixXd>& rows);
  void SetApart(const Eigen::Ref<const Eigen::MatrixXd>& rows);
  void TakeInApart();
  void Substitute(const RowTile& packs);
  Eigen::VectorXd SquaresOfQuotients(Eigen::Index rows) const;
  /// The block, whole packs of it, with zeros for the rows that were set apart.
  Eigen::MatrixXd WithoutRowsOfNewDirections(const Eigen::MatrixXd& block);
  Eigen::MatrixXd Gram() const;
  void Condition();
  void Fold();

  const simd::Kernels* kernels_;
  std::int64_t num_rows_ = 0;
  Eigen::MatrixXd sample_;  // first rows, until there are enough for U
  Eigen::Index sampled_ = 0;
  bool conditioned_ = false;

  Eigen::MatrixXd R_;  // of the rows that were folded
  std::int64_t folded_ = 0;
  Eigen::MatrixXd U_;  // R_, made invertible
  Eigen::VectorXd inverse_diagonal_;
  Eigen::MatrixXd within_;  // R_ = within_ U_
  std::int64_t unfolded_ = 0;
  Eigen::MatrixXd apart_;  // rows for Householder, as many as there are columns at a time
  Eigen::Index num_apart_ = 0;
  Eigen::VectorXd squares_;  // of the quotients added to U, by column
  simd::AlignedDoubles T_;
  simd::AlignedDoubles sums_;  // of T'T, in lanes
};

/// Reduces tiles 0 ... num_tiles - 1 on so many threads, in parts whose number and size depend on
/// num_tiles alone, so that the triangle does not depend on the threads. `add(first, last, part)`
/// adds the rows of tiles first ... last - 1.
RowReduction ReduceTiles(int num_cols,
                         int num_tiles,
                         int threads,
                         const std::function<void(int first, int last, RowReduction* part)>& add,
                         const simd::Kernels& kernels = simd::ActiveKernels());

}  // namespace dhcal

#endif  // DHCAL_CORE_MATH_ROW_REDUCTION_H_
