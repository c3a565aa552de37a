// The error that a calibration's covariance lets expect is the one that predictions have. Truth:
// tests/support/recorder.h.
#include "tools/compensate/expected_error.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "problems/identify.h"
#include "residuals/registry.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

ParameterCovariance CovarianceOf(const FitResult& fit) {
  ParameterCovariance known;
  for (const ParameterResult& parameter : fit.parameters) {
    if (parameter.verdict != Verdict::kFixed) known.names.push_back(parameter.name);
  }
  known.covariance = fit.covariance;
  return known;
}

TEST(ExpectedErrors, AreThoseOfPredictionsAtNewPoses) {
  constexpr int kDraws = 12, kPoses = 40;
  double squares = 0;
  for (std::uint64_t draw = 1; draw <= kDraws; ++draw) {
    const TrueRobot truth = MakeTrueRobot(Kr15(), draw);
    ProblemSpec spec = MakeSpec(truth.nominal, KindNamed("position"), NoiseKind::kIndependent);
    spec.measurement.sigma = 50e-6;
    RecordingPlan plan;
    plan.poses = 60;
    plan.sigma = 50e-6;
    plan.seed = draw;
    const Result result = IdentifyGeometry(spec, Record(truth, spec, plan), Progress());
    ASSERT_NE(result.best(), nullptr);
    spec.robot = result.calibrated;

    Rng rng(100 + draw);
    Recording rows;
    rows.q.resize(kPoses, 6);
    for (int k = 0; k < kPoses; ++k) rows.q.row(k) = RandomJoints(spec.robot, &rng).transpose();
    Diagnostics diagnostics;
    const RealArm arm(spec, rows, &diagnostics);
    ASSERT_TRUE(diagnostics.ok()) << diagnostics.ToString();
    const auto expected = ExpectedErrors(spec, rows, arm, rows.q, CovarianceOf(*result.best()));
    ASSERT_TRUE(expected.has_value());
    const Eigen::MatrixXd deltas = arm.Deltas(rows.q);
    for (int k = 0; k < kPoses; ++k) {
      const Eigen::Matrix4d X = truth.Pose(rows.q.row(k).transpose());
      const Eigen::Vector3d error = arm.Pose(rows.q, deltas, k).translation() - X.block<3, 1>(0, 3);
      squares += error.squaredNorm() / ((*expected)[k] * (*expected)[k]);
    }
  }
  // Some thirty parameters per draw: four standard deviations of the mean square.
  EXPECT_NEAR(squares / (kDraws * kPoses), 1.0, 4 * std::sqrt(2.0 / (30 * kDraws)));
}

TEST(ExpectedErrors, AreNotKnownWhereOnlyEdgesKnowTheBase) {
  ProblemSpec spec = MakeSpec(Kr15(), KindNamed("straight_edge"), NoiseKind::kSharedPose);
  Recording rows;
  rows.q.setZero(1, 6);
  Diagnostics diagnostics;
  const RealArm arm(spec, rows, &diagnostics);
  EXPECT_FALSE(
      ExpectedErrors(spec, rows, arm, rows.q, {{"d1"}, Eigen::MatrixXd::Ones(1, 1)}).has_value());
}

}  // namespace
}  // namespace dhcal
