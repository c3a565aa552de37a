// Products of tall matrices, for core/math/products.h. Included by the sources kernels_*.cc only.
//
// A'B is a sum over rows: lane l adds rows l, l + 8, ... and the lanes are added in order, at every
// level. A C is a sum over the columns of A, ascending, so that the vector's width changes nothing.
#ifndef DHCAL_CORE_SIMD_PRODUCT_KERNEL_H_
#define DHCAL_CORE_SIMD_PRODUCT_KERNEL_H_

#include <cstddef>

#include "core/simd/kernels.h"
#include "core/simd/vec.h"

namespace dhcal::simd {
namespace {

// Sums held in registers are four times these: AVX-512 has 32 registers, the others 16.
constexpr int kProductCols = kWidth == 8 ? 4 : 2;

/// products(i, j) += A_i' B_j for `Rows` columns of A from `i` on and `Cols` of B from `j` on.
template <int Rows, int Cols>
DHCAL_INLINE void CrossEntries(const CrossArgs& args, int i, int j) {
  const double* a[Rows];
  const double* b[Cols];
  for (int r = 0; r < Rows; ++r) a[r] = args.A + (i + r) * args.stride_A;
  for (int c = 0; c < Cols; ++c) b[c] = args.B + (j + c) * args.stride_B;
  double lanes[Rows][Cols][kLanes];
  for (int part = 0; part < kLanes; part += kWidth) {
    Vec sum[Rows][Cols] = {};
    for (int row = part; row < args.num_rows; row += kLanes) {
      Vec right[Cols];
      for (int c = 0; c < Cols; ++c) right[c] = Load(b[c] + row);
      for (int r = 0; r < Rows; ++r) {
        const Vec left = Load(a[r] + row);
        for (int c = 0; c < Cols; ++c) sum[r][c] += left * right[c];
      }
    }
    for (int r = 0; r < Rows; ++r) {
      for (int c = 0; c < Cols; ++c) Store(lanes[r][c] + part, sum[r][c]);
    }
  }
  for (int c = 0; c < Cols; ++c) {
    double* const to = args.products + (j + c) * args.stride_products + i;
    for (int r = 0; r < Rows; ++r) {
      double sum = lanes[r][c][0];
      for (int lane = 1; lane < kLanes; ++lane) sum += lanes[r][c][lane];
      to[r] += sum;
    }
  }
}

template <int Cols>
DHCAL_INLINE void CrossColumns(const CrossArgs& args, int j) {
  // Of a symmetric product, the entries above the diagonal of its blocks are not asked for.
  int i = args.lower_only ? j : 0;
  for (; i + 4 <= args.cols_A; i += 4) CrossEntries<4, Cols>(args, i, j);
  for (; i < args.cols_A; ++i) CrossEntries<1, Cols>(args, i, j);
}

void Cross(const CrossArgs& args) {
  int j = 0;
  for (; j + kProductCols <= args.cols_B; j += kProductCols) CrossColumns<kProductCols>(args, j);
  for (; j < args.cols_B; ++j) CrossColumns<1>(args, j);
}

/// B(rows, j ...) -= A(rows, :) C(:, j ...) for `Vecs` vectors of rows.
template <int Vecs, int Cols>
DHCAL_INLINE void DeductBlock(const DeductArgs& args, int row, int j) {
  Vec left[Vecs][Cols];
  for (int c = 0; c < Cols; ++c) {
    const double* const from = args.B + (j + c) * args.stride_B + row;
    for (int v = 0; v < Vecs; ++v) left[v][c] = Load(from + v * kWidth);
  }
  for (int k = 0; k < args.cols_A; ++k) {
    Vec a[Vecs];
    const double* const of_A = args.A + k * args.stride_A + row;
    for (int v = 0; v < Vecs; ++v) a[v] = Load(of_A + v * kWidth);
    for (int c = 0; c < Cols; ++c) {
      const Vec factor = All(args.C[(j + c) * args.stride_C + k]);
      for (int v = 0; v < Vecs; ++v) left[v][c] -= a[v] * factor;
    }
  }
  for (int c = 0; c < Cols; ++c) {
    double* const to = args.B + (j + c) * args.stride_B + row;
    for (int v = 0; v < Vecs; ++v) Store(to + v * kWidth, left[v][c]);
  }
}

template <int Vecs>
DHCAL_INLINE void DeductRows(const DeductArgs& args, int row) {
  int j = 0;
  for (; j + 4 <= args.cols_B; j += 4) DeductBlock<Vecs, 4>(args, row, j);
  for (; j < args.cols_B; ++j) DeductBlock<Vecs, 1>(args, row, j);
}

void Deduct(const DeductArgs& args) {
  int row = 0;
  for (; row + kProductCols * kWidth <= args.num_rows; row += kProductCols * kWidth) {
    DeductRows<kProductCols>(args, row);
  }
  for (; row < args.num_rows; row += kWidth) DeductRows<1>(args, row);
}

}  // namespace
}  // namespace dhcal::simd

#endif  // DHCAL_CORE_SIMD_PRODUCT_KERNEL_H_
