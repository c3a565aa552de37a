// The rows of the diagnosis are those of the residual blocks: same derivatives, same residuals.
#include "problems/diagnosis/design_rows.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/solver/linearization.h"
#include "problems/assembly.h"
#include "problems/diagnosis/projection.h"
#include "residuals/registry.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

struct Kind {
  const char* name;
  MeasurementKind kind;
  NoiseKind noise;
};

class DesignRowsLaw : public testing::TestWithParam<Kind> {};

TEST_P(DesignRowsLaw, LeaveTheSameSquaresAsTheResidualBlocks) {
  const TrueRobot truth = MakeTrueRobot(Kr15(), 4);
  ProblemSpec spec = MakeSpec(truth.nominal, GetParam().kind, GetParam().noise);
  if (GetParam().kind.name == "distance") {
    spec.measurement.anchors = {{"a", Eigen::Vector3d(2, 0, 0)}, {"b", Eigen::Vector3d(0, 2, 1)}};
  }
  RecordingPlan plan;
  plan.poses = 60;
  const Recording recording = Record(truth, spec, plan);
  spec.parameters.effects.resize(1);
  spec.parameters.effects[0].effect = "joint_gain";
  spec.parameters.effects[0].joint = 3;
  const Calibration c(spec, recording);
  const Noise noise{20e-6, 50e-6};
  const Eigen::VectorXd state =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(c.parameters.size()), 1e-4);

  CalibrationProblem problem(c, noise);
  problem.set_state(state);
  Linearization linear;
  ASSERT_TRUE(Linearize(&problem, &linear));
  const DesignRows rows(c, state, noise, c.readings.fitted);
  const Eigen::MatrixXd J = rows.Geometry(c.parameters);

  const Eigen::MatrixXd normal = linear.R.transpose() * linear.R;
  const Eigen::VectorXd right = linear.R.transpose() * linear.b;
  EXPECT_LT((J.transpose() * J - normal).norm(), 1e-9 * normal.norm());
  EXPECT_LT((J.transpose() * rows.y() - right).norm(), 1e-9 * right.norm());
  EXPECT_NEAR(rows.y().squaredNorm(), 2 * linear.cost, 1e-9 * linear.cost);
  // A difference holds three readings; a series of shared ones has three rows more, and three
  // offsets that take them away again.
  EXPECT_EQ(rows.degrees_of_freedom(),
            static_cast<int>(c.readings.fitted.size()) * GetParam().kind.num_coordinates());
}

INSTANTIATE_TEST_SUITE_P(
    Kinds,
    DesignRowsLaw,
    testing::Values(Kind{"position", KindNamed("position"), NoiseKind::kIndependent},
                    Kind{"pose", KindNamed("pose"), NoiseKind::kIndependent},
                    Kind{"adjacent", KindNamed("adjacent_position"), NoiseKind::kIndependent},
                    Kind{"shared", KindNamed("adjacent_position"), NoiseKind::kSharedPose},
                    Kind{"distance", KindNamed("distance"), NoiseKind::kIndependent}),
    [](const auto& param) { return std::string(param.param.name); });

TEST(WhitenSerially, TakesTheReadingBeforeOutOfRowsAndColumnsAlikeWithinRuns) {
  const TrueRobot truth = MakeTrueRobot(Kr15(), 5);
  ProblemSpec spec = MakeSpec(truth.nominal, KindNamed("position"), NoiseKind::kIndependent);
  spec.parameters.effects.resize(1);
  spec.parameters.effects[0].effect = "joint_gain";
  spec.parameters.effects[0].joint = 3;
  RecordingPlan plan;
  plan.poses = 20;
  Recording recording = Record(truth, spec, plan);
  recording.run_names = {"one", "two"};
  for (int row = 0; row < 20; ++row) recording.run_idx.push_back(row < 8 ? 0 : 1);
  const Calibration c(spec, recording);
  const Eigen::VectorXd state =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(c.parameters.size()));
  const DesignRows plain(c, state, {20e-6, 50e-6}, c.readings.fitted);
  DesignRows white = plain;
  ASSERT_TRUE(white.CanWhiten());
  const double rho = 0.6, scale = 1 / std::sqrt(1 - rho * rho);
  white.WhitenSerially(rho);
  const Eigen::MatrixXd J = plain.Geometry(c.parameters), J_white = white.Geometry(c.parameters);
  ASSERT_EQ(J_white.rows(), 60);
  for (int k = 0; k < 60; ++k) {
    const int row = k / 3;
    const bool first = row == 0 || row == 8;
    const double own = first ? 1 : scale, before = first ? 0 : rho * scale;
    const int k_before = first ? k : k - 3;
    EXPECT_NEAR(white.y()[k],
                own * plain.y()[k] - before * plain.y()[k_before],
                1e-12 * plain.y().cwiseAbs().maxCoeff());
    EXPECT_LT((J_white.row(k) - (own * J.row(k) - before * J.row(k_before))).cwiseAbs().maxCoeff(),
              1e-12 * J.cwiseAbs().maxCoeff());
  }
}

TEST(OrthonormalBasis, MakesNoDirectionsOutOfRounding) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Random(30, 4);
  J.col(2).setConstant(1e-13);
  J.col(3) = J.col(0) + 2 * J.col(1);
  EXPECT_EQ(OrthonormalBasis(J).cols(), 2);
}

TEST(RmsAsRead, IsOfTheLengthsByEachRowsOwnSigma) {
  Draw draw = MakeDraw(Scenario(), 1);
  draw.recording.sigma.setConstant(draw.recording.num_rows(), 1e-3);
  draw.recording.sigma[1] = 3e-3;
  Calibration c(draw.spec, draw.recording);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(6);
  const double expected = std::sqrt((1e-6 + 9e-6) / 2);
  EXPECT_NEAR(RmsAsRead(c, {}, {0, 0, 0, 1, 1, 1}, ones), expected, 1e-15);
  draw.spec.measurement.kind = KindNamed("pose");
  Eigen::VectorXd pose = Eigen::VectorXd::Ones(12);
  pose.segment(3, 3).setConstant(100);
  EXPECT_NEAR(RmsAsRead(c, {}, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, pose), expected, 1e-15);
  EXPECT_TRUE(std::isnan(RmsAsRead(c, {}, {}, {})));
}

TEST(FlagOutliers, WhatWasTakenOutOfARowMakesItStandOutMore) {
  // A row of which a free offset takes half: the same residual is larger by the root of two.
  Rng rng(7);
  Eigen::VectorXd y(300);
  for (double& value : y) value = rng.Normal();
  y.segment<3>(30) = Eigen::Vector3d(4, 0, 0);
  OutlierRule rule;
  EXPECT_FALSE(FlagOutliers(y, Eigen::MatrixXd(300, 0), 3, rule)[10]);
  rule.leverage = Eigen::VectorXd::Zero(300);
  rule.leverage.segment<3>(30).setConstant(0.5);
  EXPECT_TRUE(FlagOutliers(y, Eigen::MatrixXd(300, 0), 3, rule)[10]);
}

TEST(FlagOutliers, FindsTheOddReadingsAndNoOthers) {
  Eigen::VectorXd y = Eigen::VectorXd::Random(300);
  y[31] = 30;
  y[200] = -25;
  const auto flagged = FlagOutliers(y, Eigen::MatrixXd::Zero(300, 0), 3);
  for (std::size_t k = 0; k < flagged.size(); ++k) {
    EXPECT_EQ(flagged[k], k == 10 || k == 66) << k;
  }
}

TEST(FlagOutliers, DoesNotDependOnTheAxes) {
  const Eigen::Matrix3d R = MakeFrame({0, 0, 0}, {0.3, -0.8, 1.9}).linear();
  Eigen::MatrixXd U = OrthonormalBasis(Eigen::MatrixXd::Random(300, 12));
  Eigen::VectorXd y = Eigen::VectorXd::Random(300);
  // Heavy tails, so that many readings lie near the border.
  for (double& value : y) value = value * value * value * value * value;
  Eigen::VectorXd turned_y = y;
  Eigen::MatrixXd turned_U = U;
  for (Eigen::Index first = 0; first < 300; first += 3) {
    turned_y.segment<3>(first) = R * y.segment<3>(first);
    turned_U.middleRows(first, 3) = R * U.middleRows(first, 3);
  }
  EXPECT_EQ(FlagOutliers(y, U, 3), FlagOutliers(turned_y, turned_U, 3));
}

TEST(FlagOutliers, AModelThatFitsFarBelowTheNoiseHasNone) {
  Eigen::VectorXd y = 1e-6 * Eigen::VectorXd::Random(300);
  y[31] = 1e-3;
  const auto flagged = FlagOutliers(y, Eigen::MatrixXd::Zero(300, 0), 3);
  EXPECT_EQ(std::count(flagged.begin(), flagged.end(), true), 0);
}

TEST(FlagOutliers, FlagsNormalNoiseAsRarelyAsItSays) {
  // 2e-5 per reading: of 30,000 none or a few.
  Rng rng(3);
  for (const int coordinates : {1, 3, 6}) {
    Eigen::VectorXd y(30000 * coordinates);
    for (double& value : y) value = rng.Normal();
    const auto flagged = FlagOutliers(y, Eigen::MatrixXd::Zero(y.size(), 0), coordinates);
    EXPECT_LE(std::count(flagged.begin(), flagged.end(), true), 5) << coordinates;
  }
}

TEST(FlagOutliers, ATenthOfTheRowsAreNoOutliers) {
  Eigen::VectorXd y = Eigen::VectorXd::Random(300);
  for (int k = 0; k < 30; ++k) y[9 * k] = 40;
  for (const bool flagged : FlagOutliers(y, Eigen::MatrixXd::Zero(300, 0), 3)) {
    EXPECT_FALSE(flagged);
  }
}

}  // namespace
}  // namespace dhcal
