#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/math/rotation.h"
#include "tests/support/matchers.h"

namespace dhcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRpyRounding = 4e-15;  // a few roundings of numbers of size one

TEST(RotationFromRpy, TurnsAboutFixedXThenYThenZ) {
  // x -> x (roll) -> -z (pitch) -> -z (yaw); y -> z -> x -> y; z -> -y -> -y -> x.
  Matrix3d expected;
  expected << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  EXPECT_THAT(RotationFromRpy(Vector3d(kPi / 2, kPi / 2, kPi / 2)), MatrixNear(expected, 1e-15));
}

TEST(RotationFromRpy, IsTheProductOfThreeRotationVectors) {
  const Vector3d rpy(0.3, -1.1, 2.5);
  const Matrix3d product = ExpSO3<double>(Vector3d(0, 0, rpy.z())) *
                           ExpSO3<double>(Vector3d(0, rpy.y(), 0)) *
                           ExpSO3<double>(Vector3d(rpy.x(), 0, 0));
  EXPECT_THAT(RotationFromRpy(rpy), MatrixNear(product, kRpyRounding));
}

TEST(RpyFromRotation, UndoesRotationFromRpy) {
  Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    const Vector3d rpy(rng.Uniform(-3.1, 3.1), rng.Uniform(-1.5, 1.5), rng.Uniform(-3.1, 3.1));
    // Roll and yaw lose what cos(pitch) > 0.07 takes from them.
    EXPECT_THAT(RpyFromRotation(RotationFromRpy(rpy)), MatrixNear(rpy, 1e-13));
  }
}

TEST(RpyFromRotation, ChoosesRollZeroWherePitchIsRight) {
  for (const double pitch : {kPi / 2, -kPi / 2}) {
    const Matrix3d R = RotationFromRpy(Vector3d(0.4, pitch, 1.3));
    const Vector3d rpy = RpyFromRotation(R);
    EXPECT_EQ(rpy.x(), 0.0);
    EXPECT_NEAR(rpy.y(), pitch, kRpyRounding);
    EXPECT_THAT(RotationFromRpy(rpy), MatrixNear(R, kRpyRounding));
  }
}

TEST(RpyFromRotation, GivesTheSameRotationCloseToRightPitch) {
  Rng rng(2);
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-11}) {
    const Vector3d rpy(rng.Uniform(-3, 3), kPi / 2 - gap, rng.Uniform(-3, 3));
    const Matrix3d R = RotationFromRpy(rpy);
    // Yaw comes from entries of size `gap` and may be wrong by their rounding; roll makes up for
    // it.
    EXPECT_THAT(RotationFromRpy(RpyFromRotation(R)), MatrixNear(R, 1e-15)) << gap;
  }
}

}  // namespace
}  // namespace dhcal
