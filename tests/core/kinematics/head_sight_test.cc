// What sensors see of planes, against an independent head and its complex step.
#include "core/kinematics/head_sight.h"

#include <complex>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/edge_head.h"

namespace dhcal {
namespace {

using Eigen::Vector3d;
using independent::Matrix4;
using Imaginary = std::complex<double>;

HeadSpec AslantHead() {
  HeadSpec head;
  head.camera.p_QS = Vector3d(0.02, 0, 0);
  head.lasers[0].p_QS = Vector3d(-0.03, 0.05, 0.01);
  head.lasers[1] = {Vector3d(-0.03, -0.05, 0.01), Vector3d(0.1, -0.2, 1).normalized()};
  head.ruler_height = 0.004;
  return head;
}

/// Over the face by some centimetres, looking down aslant.
Eigen::Isometry3d SomePose(Rng* rng) {
  const double x = rng->Uniform(-0.3, 0.3), y = rng->Uniform(-0.02, 0.02);
  const double a = rng->Uniform(-0.4, 0.4), b = rng->Uniform(-0.4, 0.4);
  return Eigen::Translation3d(x, y, rng->Uniform(0.03, 0.1)) *
         Eigen::AngleAxisd(3.1 + a, Vector3d::UnitX()) * Eigen::AngleAxisd(b, Vector3d::UnitY());
}

TEST(HeadSight, NumbersAndTwistsAreThoseOfTheIndependentHead) {
  const HeadSpec head = AslantHead();
  Rng rng(3);
  constexpr double kStep = 1e-30;
  for (int draw = 0; draw < 20; ++draw) {
    const Eigen::Isometry3d X = SomePose(&rng);
    const auto sights = SightsOf(head, X.translation(), X.linear());
    ASSERT_TRUE(sights);
    const Matrix4<Imaginary> edge = Matrix4<Imaginary>::Identity();
    EXPECT_LT((sights->numbers() -
               independent::HeadNumbers<double>(head, X.matrix(), Matrix4<double>::Identity()))
                  .norm(),
              1e-14);
    for (int k = 0; k < 6; ++k) {
      Matrix4<Imaginary> moved = X.matrix().cast<Imaginary>();
      if (k < 3) {
        moved(k, 3) += Imaginary(0, kStep);
      } else {
        const Vector3d w = Vector3d::Unit(k - 3);
        for (int column = 0; column < 3; ++column) {
          const Vector3d turned = w.cross(Vector3d(X.linear().col(column)));
          moved.block<3, 1>(0, column) += Imaginary(0, kStep) * turned.cast<Imaginary>();
        }
      }
      const Vector3d slope = independent::HeadNumbers<Imaginary>(head, moved, edge).imag() / kStep;
      EXPECT_LT((sights->by_twist().col(k) - slope).norm(), 1e-12) << k;
    }
  }
}

TEST(HeadSight, AHigherPlaneShortensSightsAndMovesTheRuling) {
  HeadSpec head = AslantHead();
  Rng rng(5);
  const Eigen::Isometry3d X = SomePose(&rng);
  const auto before = SightsOf(head, X.translation(), X.linear());
  constexpr double kRise = 1e-4;
  const Eigen::Isometry3d lower = Eigen::Translation3d(0, 0, -kRise) * X;
  const auto heights = SightsOf(head, lower.translation(), lower.linear());
  head.ruler_height += kRise;
  const auto ruler = SightsOf(head, X.translation(), X.linear());
  ASSERT_TRUE(before && heights && ruler);
  EXPECT_NEAR(
      ruler->camera.at.x() - before->camera.at.x(), kRise * before->camera.ruler_by_plane(), 1e-15);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(heights->lasers[k].length - before->lasers[k].length,
                kRise * before->lasers[k].length_by_plane(),
                1e-15);
  }
}

TEST(HeadSight, NothingIsSeenAlongTheFaces) {
  const Eigen::Matrix3d on_its_side =
      Eigen::AngleAxisd(1.5707963267948966, Vector3d::UnitX()).toRotationMatrix();
  EXPECT_FALSE(SightsOf(AslantHead(), Vector3d(0, 0, 0.1), on_its_side).has_value());
}

}  // namespace
}  // namespace dhcal
