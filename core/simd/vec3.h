// Vectors and rotations of space at kWidth poses. Included by the sources kernels_*.cc only
// (SIMD.md).
#ifndef DHCAL_CORE_SIMD_VEC3_H_
#define DHCAL_CORE_SIMD_VEC3_H_

#include <cstddef>

#include "core/simd/vec.h"

namespace dhcal::simd {
namespace {

struct Vec3 {
  Vec x, y, z;
};

DHCAL_INLINE Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
DHCAL_INLINE Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
DHCAL_INLINE Vec3 operator*(Vec s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
DHCAL_INLINE Vec3 Cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
DHCAL_INLINE Vec3 All(const double* v) { return {All(v[0]), All(v[1]), All(v[2])}; }
DHCAL_INLINE Vec3 Load3(const double* from, std::ptrdiff_t stride) {
  return {Load(from), Load(from + stride), Load(from + 2 * stride)};
}
DHCAL_INLINE void Store3(double* to, std::ptrdiff_t stride, const Vec3& v) {
  Store(to, v.x);
  Store(to + stride, v.y);
  Store(to + 2 * stride, v.z);
}

/// A rotation by its columns, the axes of the turned frame.
struct Axes {
  Vec3 x, y, z;
};

DHCAL_INLINE Axes AllAxes(const double* R) { return {All(R), All(R + 3), All(R + 6)}; }
DHCAL_INLINE Vec3 operator*(const Axes& R, const Vec3& v) {
  return v.x * R.x + v.y * R.y + v.z * R.z;
}
DHCAL_INLINE Axes operator*(const Axes& R, const Axes& S) { return {R * S.x, R * S.y, R * S.z}; }

/// Turns two axes about the third.
DHCAL_INLINE void Turn(const SinCos& by, Vec3* first, Vec3* second) {
  const Vec3 turned = by.cos * *first + by.sin * *second;
  *second = by.cos * *second - by.sin * *first;
  *first = turned;
}

}  // namespace
}  // namespace dhcal::simd

#endif  // DHCAL_CORE_SIMD_VEC3_H_
