#include "tools/bench/bare_kernel.h"

// The width that this source's options (-march=native) allow.
#if defined(__AVX512F__)
#define DHCAL_SIMD_WIDTH 8
#elif defined(__AVX__)
#define DHCAL_SIMD_WIDTH 4
#else
#define DHCAL_SIMD_WIDTH 2
#endif
#include "core/simd/gram_kernel.h"
#include "core/simd/kernels.h"
#include "core/simd/vec.h"
#include "core/simd/vec3.h"

namespace dhcal {
namespace {

using simd::kLanes;
using simd::Vec;
using simd::Vec3;

// Packs of poses whose rows are kept before their products are summed.
constexpr int kPacksTogether = 4;
constexpr int kReadings = kBareJoints + 3;

/// Rows of one vector of poses, written where Gram reads them: coordinate c of the pose is in the
/// pack c of three.
class BareRows {
 public:
  DHCAL_INLINE BareRows(double* T, int lane) : T_(T + lane) {}

  DHCAL_INLINE void Put(int column, const Vec3& v) const {
    simd::Store(At(column, 0), v.x);
    simd::Store(At(column, 1), v.y);
    simd::Store(At(column, 2), v.z);
  }

 private:
  DHCAL_INLINE double* At(int column, int coordinate) const {
    return T_ + (coordinate * kBareColumns + column) * kLanes;
  }
  double* T_;
};

/// `cos_alpha`, `sin_alpha` of each row.
DHCAL_INLINE void PutRows(const BareRobot& robot,
                          const double* cos_alpha,
                          const double* sin_alpha,
                          const double* readings,
                          const BareRows& rows) {
  const Vec zero{}, one = simd::All(1);
  Vec3 x{one, zero, zero}, y{zero, one, zero}, z{zero, zero, one}, o{zero, zero, zero};
  Vec3 axis[kBareJoints], before[kBareJoints], twist[kBareJoints], after[kBareJoints];
  for (int i = 0; i < kBareJoints; ++i) {
    const simd::SinCos theta = simd::SinCosOf(simd::Load(readings + i * kLanes) + robot.theta[i]);
    axis[i] = z;
    before[i] = o;
    simd::Turn(theta, &x, &y);
    twist[i] = x;
    o = o + simd::All(robot.d[i]) * z + simd::All(robot.a[i]) * x;
    after[i] = o;
    rows.Put(4 * i + 1, z);
    rows.Put(4 * i + 2, x);
    simd::Turn({simd::All(sin_alpha[i]), simd::All(cos_alpha[i])}, &y, &z);
  }
  for (int i = 0; i < kBareJoints; ++i) {
    rows.Put(4 * i, simd::Cross(axis[i], o - before[i]));
    rows.Put(4 * i + 3, simd::Cross(twist[i], o - after[i]));
  }
  rows.Put(4 * kBareJoints, simd::Load3(readings + kBareJoints * kLanes, kLanes) - o);
}

}  // namespace

void BareNormalMatrix(const BareRobot& robot, const double* readings, int num_packs, double* sums) {
  alignas(simd::kAlignment) double T[kPacksTogether * 3 * kBareColumns * kLanes];
  double cos_alpha[kBareJoints], sin_alpha[kBareJoints];
  for (int i = 0; i < kBareJoints; ++i) {
    cos_alpha[i] = __builtin_cos(robot.alpha[i]);
    sin_alpha[i] = __builtin_sin(robot.alpha[i]);
  }
  for (int pack = 0; pack < num_packs; pack += kPacksTogether) {
    const int count = num_packs - pack < kPacksTogether ? num_packs - pack : kPacksTogether;
    for (int k = 0; k < count; ++k) {
      for (int lane = 0; lane < kLanes; lane += simd::kWidth) {
        PutRows(robot,
                cos_alpha,
                sin_alpha,
                readings + (pack + k) * kReadings * kLanes + lane,
                BareRows(T + k * 3 * kBareColumns * kLanes, lane));
      }
    }
    simd::Gram({3 * count, kBareColumns, T, sums});
  }
}

}  // namespace dhcal
