#include "problems/start.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/math/rotation.h"

namespace dhcal {
namespace {

Eigen::Matrix3Xd RandomPoints(int count, Rng* rng) {
  Eigen::Matrix3Xd points(3, count);
  for (double& x : points.reshaped()) x = rng->Normal();
  return points;
}

Eigen::Isometry3d RandomFrame(Rng* rng) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d turn(rng->Normal(), 2 * rng->Normal(), rng->Normal());
  X.linear() = ExpSO3<double>(turn);
  X.translation() << rng->Normal(), 10 * rng->Normal(), rng->Normal();
  return X;
}

TEST(AlignPoints, RecoversAnyFrameFromExactPoints) {
  Rng rng(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Isometry3d X_WB = RandomFrame(&rng);
    const Eigen::Matrix3Xd p_B = RandomPoints(10, &rng);
    const Eigen::Isometry3d found = AlignPoints(p_B, X_WB * p_B);
    EXPECT_LT((found.matrix() - X_WB.matrix()).norm(), 1e-12);
  }
}

TEST(AlignPoints, IsAProperRotationEvenForMirroredPoints) {
  Rng rng(2);
  const Eigen::Matrix3Xd p_B = RandomPoints(10, &rng);
  Eigen::Matrix3Xd mirrored = p_B;
  mirrored.row(0) *= -1;
  EXPECT_NEAR(AlignPoints(p_B, mirrored).linear().determinant(), 1.0, 1e-12);
}

TEST(AlignPoints, PointsOnALineStillAlign) {
  Rng rng(3);
  const Eigen::Isometry3d X_WB = RandomFrame(&rng);
  Eigen::Matrix3Xd p_B = Eigen::Matrix3Xd::Zero(3, 5);
  for (int k = 0; k < 5; ++k) p_B.col(k) = k * Eigen::Vector3d(1, 2, 3);
  const Eigen::Isometry3d found = AlignPoints(p_B, X_WB * p_B);
  EXPECT_LT((found * p_B - X_WB * p_B).norm(), 1e-10);
}

TEST(MeanRotation, OfSmallTurnsIsTheirAverage) {
  const Eigen::Matrix3d R = ExpSO3<double>(Eigen::Vector3d(0.5, -2, 1));
  const Eigen::Vector3d turn(1e-4, 2e-4, -1e-4);
  const Eigen::Matrix3d mean = MeanRotation({R * ExpSO3<double>(turn), R * ExpSO3<double>(-turn)});
  EXPECT_LT((mean - R).norm(), 1e-12);
}

}  // namespace
}  // namespace dhcal
