// The vector of one SIMD level and its elementary functions. Included by the sources kernels_*.cc
// only, which define DHCAL_SIMD_WIDTH before; everything is internal to them (SIMD.md).
#ifndef DHCAL_CORE_SIMD_VEC_H_
#define DHCAL_CORE_SIMD_VEC_H_

#include <cstddef>
#include <cstdint>

#include "core/simd/kernels.h"

#define DHCAL_INLINE inline __attribute__((always_inline))

namespace dhcal::simd {
namespace {

constexpr int kWidth = DHCAL_SIMD_WIDTH;
static_assert(kLanes % kWidth == 0);

typedef double Vec __attribute__((vector_size(8 * kWidth)));
typedef std::int64_t Bits __attribute__((vector_size(8 * kWidth)));
// The same in memory of any alignment.
typedef double LooseVec __attribute__((vector_size(8 * kWidth), aligned(8), may_alias));

DHCAL_INLINE Vec Load(const double* from) { return *reinterpret_cast<const LooseVec*>(from); }
DHCAL_INLINE void Store(double* to, Vec v) { *reinterpret_cast<LooseVec*>(to) = v; }
DHCAL_INLINE Vec All(double x) { return x - Vec{}; }

DHCAL_INLINE Bits BitsOf(Vec v) {
  Bits bits;
  __builtin_memcpy(&bits, &v, sizeof bits);
  return bits;
}
DHCAL_INLINE Vec FromBits(Bits bits) {
  Vec v;
  __builtin_memcpy(&v, &bits, sizeof v);
  return v;
}

DHCAL_INLINE Vec Abs(Vec v) { return FromBits(BitsOf(v) & INT64_MAX); }
/// True where every lane is at most `limit`; not-a-number is not.
DHCAL_INLINE bool AllAtMost(Vec v, double limit) {
  bool all = true;
  for (int lane = 0; lane < kWidth; ++lane) all = all && v[lane] <= limit;
  return all;
}

struct SinCos {
  Vec sin, cos;
};

// Beyond it, libm.
constexpr double kLargestReduced = 1e4;  // [rad]

SinCos LibmSinCosOf(Vec x) {
  SinCos result{};
  for (int lane = 0; lane < kWidth; ++lane) {
    result.sin[lane] = __builtin_sin(x[lane]);
    result.cos[lane] = __builtin_cos(x[lane]);
  }
  return result;
}

/// To about one unit in the last place: reduction by multiples of pi/2 in three parts (Cody,
/// Waite), then the polynomials of FreeBSD's k_sin.c and k_cos.c. Not inlined: few poses need it,
/// and those that do not should keep their registers.
__attribute__((noinline)) SinCos SinCosOf(Vec x) {
  if (__builtin_expect(!AllAtMost(Abs(x), kLargestReduced), 0)) return LibmSinCosOf(x);
  // Added to a small number, it leaves that number, rounded, in the last bits.
  constexpr double kRounder = 0x1.8p52;
  const Vec rounded = x * 0x1.45f306dc9c883p-1 + kRounder;  // times 2/pi
  const Bits quarter = BitsOf(rounded);
  const Vec k = rounded - kRounder;
  const Vec first = x - k * 0x1.921fb544p+0;
  const Vec second = k * 0x1.0b4611a6p-34;
  const Vec r = first - second;
  const Vec rest = ((first - r) - second) - k * 0x1.3198a2e037073p-69;  // r + rest is exact
  const Vec z = r * r;
  const Vec odd_series = -0x1.5555555555549p-3 +
                         z * (0x1.111111110f8a6p-7 +
                              z * (-0x1.a01a019c161d5p-13 +
                                   z * (0x1.71de357b1fe7dp-19 +
                                        z * (-0x1.ae5e68a2b9cebp-26 + z * 0x1.5d93a5acfd57cp-33))));
  const Vec even_series =
      0x1.555555555554cp-5 +
      z * (-0x1.6c16c16c15177p-10 +
           z * (0x1.a01a019cb159p-16 +
                z * (-0x1.27e4f809c52adp-22 +
                     z * (0x1.1ee9ebdb4b1c4p-29 + z * -0x1.8fae9be8838d4p-37))));
  const Vec half = 0.5 * z;
  const Vec less = 1.0 - half;
  const Vec odd = r + (r * z * odd_series + rest * less);
  const Vec even = less + (((1.0 - less) - half) + (z * z * even_series - rest * r));
  const Bits swapped = (quarter & 1) != 0;
  const Bits sin_sign = (quarter & 2) << 62;
  const Bits cos_sign = ((quarter + 1) & 2) << 62;
  return {FromBits(BitsOf(swapped ? even : odd) ^ sin_sign),
          FromBits(BitsOf(swapped ? odd : even) ^ cos_sign)};
}

}  // namespace
}  // namespace dhcal::simd

#endif  // DHCAL_CORE_SIMD_VEC_H_
