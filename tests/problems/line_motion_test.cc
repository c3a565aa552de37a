// Straight paths of the simulator, judged by the forward kinematics of tests/support.
#include "problems/line_motion.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/math/rotation.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/problem_cases.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The case with the head, its motion replaced by lines.
ProblemSpec OnLines(int poses, double tilt) {
  ProblemSpec spec = LoadCase("kr15_edges");
  MotionSpec& motion = spec.simulate->motion;
  motion = MotionSpec();
  motion.kind = MotionKind::kLine;
  motion.num_poses = poses;
  motion.tilt = tilt;
  motion.home.resize(6);
  motion.home << 0.2, 80 * kDegree, -10 * kDegree, 0.1, 50 * kDegree, 0.1;
  return spec;
}

Eigen::Matrix4d PoseOf(const ProblemSpec& spec, const VectorXd& q) {
  return independent::ForwardKinematics<double>(spec.robot, q, VectorXd::Zero(42));
}

TEST(LineMotion, StandsEvenlyOnEveryLine) {
  ProblemSpec spec = OnLines(11, 0);
  Isometry3d start = Isometry3d::Identity();
  start.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  start.translation() = Vector3d(0.9, -0.2, 0.5);
  spec.simulate->motion.lines = {{start, Vector3d(0.9, 0.3, 0.5)},
                                 {start, Vector3d(1.1, -0.2, 0.7)}};
  Rng rng(1);
  Diagnostics diagnostics;
  const auto rows = LineMotion(spec, &rng, &diagnostics);
  ASSERT_TRUE(rows.has_value()) << diagnostics.ToString();
  ASSERT_EQ(rows->num_rows(), 22);
  EXPECT_EQ(rows->run_names, (std::vector<std::string>{"line1", "line2"}));
  for (int row = 0; row < 22; ++row) {
    const MotionLine& line = spec.simulate->motion.lines[static_cast<std::size_t>(row / 11)];
    const Vector3d wanted =
        start.translation() + (row % 11) / 10.0 * (line.p_WQ_end - start.translation());
    const Eigen::Matrix4d X = PoseOf(spec, rows->q.row(row).transpose());
    EXPECT_LT((X.block<3, 1>(0, 3) - wanted).norm(), 1e-9) << row;
    EXPECT_LT((X.block<3, 3>(0, 0) - start.linear()).norm(), 1e-9) << row;
    EXPECT_EQ(rows->run(row), row / 11);
  }
}

TEST(LineMotion, TiltsTheHeadOverEveryEdge) {
  const double tilt = 20 * kDegree;
  ProblemSpec spec = OnLines(20, tilt);
  spec.simulate->motion.along_edges = AlongEdges{0.4, 0.07};
  // Three placements that the home position reaches.
  spec.robot.edges.resize(3);
  Rng rng(1);
  Diagnostics diagnostics;
  const auto rows = LineMotion(spec, &rng, &diagnostics);
  ASSERT_TRUE(rows.has_value()) << diagnostics.ToString();
  ASSERT_EQ(rows->num_rows(), 60);
  double most = 0;
  for (int row = 0; row < 60; ++row) {
    const Isometry3d& X_WE = *spec.robot.edges[static_cast<std::size_t>(rows->edge(row))].X_WE;
    const Eigen::Matrix4d X = PoseOf(spec, rows->q.row(row).transpose());
    const Vector3d p_E = X_WE.inverse() * Vector3d(X.block<3, 1>(0, 3));
    EXPECT_NEAR(p_E.x(), -0.2 + 0.4 * (row % 20) / 19, 1e-9);
    EXPECT_NEAR(p_E.y(), 0, 1e-9);
    EXPECT_NEAR(p_E.z(), 0.07, 1e-9);
    const double off = std::acos(-X_WE.linear().col(2).dot(X.block<3, 1>(0, 2)));
    EXPECT_LT(off, tilt * std::sqrt(2.0));
    most = std::max(most, off);
  }
  EXPECT_GT(most, tilt / 2);
}

TEST(LineMotion, SaysWhichPoseIsOutOfReach) {
  ProblemSpec spec = OnLines(5, 0);
  Isometry3d start = Isometry3d::Identity();
  start.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  start.translation() = Vector3d(0.9, 0, 0.5);
  spec.simulate->motion.lines = {{start, Vector3d(3.3, 0, 0.5)}};
  Rng rng(1);
  Diagnostics diagnostics;
  EXPECT_FALSE(LineMotion(spec, &rng, &diagnostics).has_value());
  EXPECT_THAT(diagnostics.ToString(), testing::HasSubstr("pose 3 of line 1: out of reach"));
}

}  // namespace
}  // namespace dhcal
