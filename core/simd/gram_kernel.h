// Products of all columns of a tile of rows with each other, for core/math/row_reduction.h.
// Included by the sources kernels_*.cc only. A sum is over the rows of its lane, ascending, at
// every level.
#ifndef DHCAL_CORE_SIMD_GRAM_KERNEL_H_
#define DHCAL_CORE_SIMD_GRAM_KERNEL_H_

#include <cstddef>

#include "core/simd/kernels.h"
#include "core/simd/vec.h"

namespace dhcal::simd {
namespace {

// Sums held in registers are four times these: AVX-512 has 32 registers, the others 16.
constexpr int kColsTogether = kWidth == 8 ? 4 : 2;

/// `Rows` x `Cols` entries of one block of sums, `row` and `col` their columns of T.
template <int Rows, int Cols>
DHCAL_INLINE void GramEntries(const GramArgs& args, int row, int col, double* sums) {
  const std::ptrdiff_t pack_size = std::ptrdiff_t{args.num_cols} * kLanes;
  for (int part = 0; part < kLanes; part += kWidth) {
    const double* T = args.T + part;
    double* to = sums + part;
    Vec sum[Rows][Cols];
    for (int i = 0; i < Rows; ++i) {
      for (int j = 0; j < Cols; ++j) sum[i][j] = Load(to + (i * kGramBlock + j) * kLanes);
    }
    for (int pack = 0; pack < args.num_packs; ++pack, T += pack_size) {
      Vec b[Cols];
      for (int j = 0; j < Cols; ++j) b[j] = Load(T + (col + j) * kLanes);
      for (int i = 0; i < Rows; ++i) {
        const Vec a = Load(T + (row + i) * kLanes);
        for (int j = 0; j < Cols; ++j) sum[i][j] += a * b[j];
      }
    }
    for (int i = 0; i < Rows; ++i) {
      for (int j = 0; j < Cols; ++j) Store(to + (i * kGramBlock + j) * kLanes, sum[i][j]);
    }
  }
}

/// A block of sums with all its columns.
template <int Rows>
DHCAL_INLINE void GramBlock(const GramArgs& args, int row, int col, double* sums) {
  int j = 0;
  const int num_cols = args.num_cols - col < kGramBlock ? args.num_cols - col : kGramBlock;
  for (; j + kColsTogether <= num_cols; j += kColsTogether) {
    GramEntries<Rows, kColsTogether>(args, row, col + j, sums + j * kLanes);
  }
  for (; j < num_cols; ++j) GramEntries<Rows, 1>(args, row, col + j, sums + j * kLanes);
}

void Gram(const GramArgs& args) {
  double* sums = args.sums;
  for (int row = 0; row < args.num_cols; row += kGramBlock) {
    const int num_rows = args.num_cols - row;
    for (int col = 0; col <= row; col += kGramBlock, sums += kGramBlock * kGramBlock * kLanes) {
      if (num_rows >= 4) {
        GramBlock<4>(args, row, col, sums);
      } else if (num_rows == 3) {
        GramBlock<3>(args, row, col, sums);
      } else if (num_rows == 2) {
        GramBlock<2>(args, row, col, sums);
      } else {
        GramBlock<1>(args, row, col, sums);
      }
    }
  }
}

}  // namespace
}  // namespace dhcal::simd

#endif  // DHCAL_CORE_SIMD_GRAM_KERNEL_H_
