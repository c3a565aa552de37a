// Division of rows by a triangle, for core/math/row_reduction.h. Included by the sources
// kernels_*.cc only.
//
// Every number is one sum in one order: T(r, k) over the columns before k, ascending. How many of
// them are kept in registers at a time differs between levels and changes nothing.
#ifndef DHCAL_CORE_SIMD_SUBSTITUTE_KERNEL_H_
#define DHCAL_CORE_SIMD_SUBSTITUTE_KERNEL_H_

#include "core/simd/kernels.h"
#include "core/simd/vec.h"

namespace dhcal::simd {
namespace {

constexpr int kVecsPerPack = kLanes / kWidth;
// Sums held in registers are these times four: AVX-512 has 32 registers, the others 16.
constexpr int kVecsTogether = kWidth == 8 ? 4 : 2;

/// Rows of J as vectors, and where T has them.
class RowVecs {
 public:
  DHCAL_INLINE explicit RowVecs(const SubstituteArgs& args) : args_(args) {}

  DHCAL_INLINE Vec Weighted(int vec, int col) const {
    const std::ptrdiff_t row = std::ptrdiff_t{vec} * kWidth;
    const Vec J = Load(args_.J + col * args_.stride + row);
    return args_.weight == nullptr ? J : J * Load(args_.weight + row);
  }
  DHCAL_INLINE double* T(int vec, int col) const {
    const std::ptrdiff_t pack = vec / kVecsPerPack, part = vec % kVecsPerPack;
    return args_.T + (pack * args_.num_cols + col) * kLanes + part * kWidth;
  }

 private:
  const SubstituteArgs& args_;
};

/// `Vecs` vectors from `vec` on, columns `col` ... `col + Cols`; those before are done.
template <int Vecs, int Cols>
DHCAL_INLINE void SubstituteBlock(const SubstituteArgs& args, int vec, int col) {
  const RowVecs rows(args);
  const std::ptrdiff_t n = args.num_cols;
  const double* U = args.U + col * n;
  Vec t[Vecs][Cols];
  for (int v = 0; v < Vecs; ++v) {
    for (int c = 0; c < Cols; ++c) t[v][c] = rows.Weighted(vec + v, col + c);
  }
  const double* before[Vecs];
  for (int v = 0; v < Vecs; ++v) before[v] = rows.T(vec + v, 0);
  for (int k = 0; k < col; ++k) {
    for (int v = 0; v < Vecs; ++v) {
      const Vec t_k = Load(before[v] + k * kLanes);
      for (int c = 0; c < Cols; ++c) t[v][c] -= t_k * U[c * n + k];
    }
  }
  for (int c = 0; c < Cols; ++c) {
    for (int v = 0; v < Vecs; ++v) {
      for (int k = 0; k < c; ++k) t[v][c] -= t[v][k] * U[c * n + col + k];
      t[v][c] *= args.inverse_diagonal[col + c];
      Store(rows.T(vec + v, col + c), t[v][c]);
    }
  }
}

template <int Vecs>
inline void SubstituteRows(const SubstituteArgs& args, int vec) {
  int col = 0;
  for (; col + kGramBlock <= args.num_cols; col += kGramBlock) {
    SubstituteBlock<Vecs, kGramBlock>(args, vec, col);
  }
  for (; col < args.num_cols; ++col) {
    SubstituteBlock<Vecs, 1>(args, vec, col);
  }
}

void Substitute(const SubstituteArgs& args) {
  const int num_vecs = args.num_packs * kVecsPerPack;
  int vec = 0;
  for (; vec + kVecsTogether <= num_vecs; vec += kVecsTogether) {
    SubstituteRows<kVecsTogether>(args, vec);
  }
  for (; vec < num_vecs; ++vec) SubstituteRows<1>(args, vec);
}

}  // namespace
}  // namespace dhcal::simd

#endif  // DHCAL_CORE_SIMD_SUBSTITUTE_KERNEL_H_
