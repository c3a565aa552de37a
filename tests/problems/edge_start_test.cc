// Where edges stand, from what a head reads over them. Truth: tests/support/edge_head.h.
#include "problems/edge_start.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/edge_head.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kHalfTurn = 3.14159265358979;

HeadSpec HeadWithLasersAt(const Vector3d& first, const Vector3d& second) {
  HeadSpec head;
  head.camera.p_QS = Vector3d(0.02, 0, 0);
  head.lasers[0].p_QS = first;
  head.lasers[1].p_QS = second;
  head.ruler_height = 0.003;
  return head;
}

/// A head along 0.5 m of an edge, tilted by up to `tilt` [rad].
EdgeRows RowsAlong(const HeadSpec& head, const Isometry3d& X_BE, double tilt) {
  Rng rng(3);
  EdgeRows rows;
  for (int k = 0; k < 15; ++k) {
    const Vector3d turn(
        rng.Uniform(-tilt, tilt), rng.Uniform(-tilt, tilt), rng.Uniform(-tilt, tilt));
    const Isometry3d X_BQ = X_BE * MakeFrame({-0.25 + k * 0.035, 0, 0.06}, {kHalfTurn, 0, 0}) *
                            MakeFrame({0, 0, 0}, turn);
    rows.X_BQ.push_back(X_BQ);
    rows.numbers.emplace_back(independent::HeadNumbers<double>(head, X_BQ.matrix(), X_BE.matrix()));
  }
  return rows;
}

TEST(AlignEdge, FindsTheFaceTheRulerAndItsZero) {
  const HeadSpec head = HeadWithLasersAt({-0.03, 0.05, 0.01}, {-0.03, -0.05, 0.01});
  const Isometry3d X_BE = MakeFrame({0.9, -0.3, 0.4}, {0.3, -0.5, 2.2});
  const auto found = AlignEdge(head, RowsAlong(head, X_BE, 0.4));
  ASSERT_TRUE(found.has_value());
  EXPECT_LT((found->linear() - X_BE.linear()).norm(), 1e-12);
  // Across the edge nothing has a place.
  const Vector3d off = X_BE.linear().transpose() * (found->translation() - X_BE.translation());
  EXPECT_NEAR(off.x(), 0, 1e-12);
  EXPECT_NEAR(off.z(), 0, 1e-12);
}

TEST(AlignEdge, TakesTheFaceAcrossTheSightsWhereAllSpotsAreOnOneLine) {
  const HeadSpec head = HeadWithLasersAt({-0.03, 0, 0.01}, {0.04, 0, 0.01});
  const Isometry3d X_BE = MakeFrame({0.9, -0.3, 0.4}, {0.3, -0.5, 2.2});
  const auto found = AlignEdge(head, RowsAlong(head, X_BE, 0));
  ASSERT_TRUE(found.has_value());
  EXPECT_LT((found->linear() - X_BE.linear()).norm(), 1e-9);
}

TEST(AlignEdge, FindsNothingWhereTheHeadStandsStill) {
  const HeadSpec head = HeadWithLasersAt({-0.03, 0.05, 0.01}, {-0.03, -0.05, 0.01});
  EdgeRows rows = RowsAlong(head, Isometry3d::Identity(), 0);
  rows.X_BQ.assign(4, rows.X_BQ[0]);
  rows.numbers.assign(4, rows.numbers[0]);
  EXPECT_FALSE(AlignEdge(head, rows).has_value());
  EXPECT_FALSE(AlignEdge(head, EdgeRows()).has_value());
}

}  // namespace
}  // namespace dhcal
