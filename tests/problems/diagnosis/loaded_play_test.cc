// A wrist joint has play and a load whose masses nobody states: the joint leans on one flank of its
// gear or on the other. Free moments would imitate it as a compliance.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "residuals/registry.h"
#include "tests/support/problem_cases.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

/// Positions of an arm whose joint leans to where a tool's weight presses it, with its centre
/// anywhere within a cone of 35 deg about the flange's axis.
Recording WithLoadedPlay(
    const TrueRobot& truth, const ProblemSpec& spec, int joint, double width, std::uint64_t seed) {
  constexpr double kReach = 0.2;     // [m]
  constexpr double kAttempt = 1e-4;  // [rad]
  Rng rng(900 + seed);
  RecordingPlan plan;
  plan.seed = seed;
  Recording recording = Record(truth, spec, plan);
  const double tilt = rng.Uniform(0, 35 * kDegree), turn = rng.Uniform(-kPi, kPi);
  const Eigen::Vector3d p_TC(kReach * std::sin(tilt) * std::cos(turn),
                             kReach * std::sin(tilt) * std::sin(turn),
                             kReach * std::cos(tilt));
  const Eigen::Vector3d p_QC = truth.nominal.X_TQ.inverse() * p_TC;
  const Eigen::Vector3d down_V =
      (truth.X_VW * truth.nominal.X_WB).linear() * truth.nominal.gravity_B;
  const auto depth = [&](const Eigen::VectorXd& q) {
    return down_V.dot((truth.Pose(q) * p_QC.homogeneous()).head<3>());
  };
  for (int row = 0; row < plan.poses; ++row) {
    Eigen::VectorXd q = recording.q.row(row).transpose();
    const Eigen::Vector3d before = truth.Pose(q).topRightCorner<3, 1>();
    Eigen::VectorXd attempt = q;
    attempt[joint] += kAttempt;
    q[joint] += std::copysign(width / 2, depth(attempt) - depth(q));
    recording.p_WQ.row(row) += (truth.Pose(q).topRightCorner<3, 1>() - before).transpose();
  }
  return recording;
}

TEST(LoadedPlay, OfAWristWithoutMassesIsNoCompliance) {
  int right = 0, trials = 0;
  for (const int joint : {3, 4}) {
    for (std::uint64_t seed = 11; seed <= 14; ++seed, ++trials) {
      const TrueRobot truth = MakeTrueRobot(Kr15(), seed);
      const ProblemSpec spec =
          MakeSpec(truth.nominal, KindNamed("position"), NoiseKind::kIndependent);
      const DiagnosisResult d = Diagnosed(spec, WithLoadedPlay(truth, spec, joint, 5e-4, seed));
      ASSERT_FALSE(d.findings.empty()) << joint + 1 << ", " << seed;
      const Finding& first = d.findings.front();
      EXPECT_NE(first.effect.effect, "joint_compliance") << joint + 1 << ", " << seed;
      if (first.effect.effect == "backlash" && first.effect.joint == joint + 1) ++right;
    }
  }
  EXPECT_GE(right, trials - 1);
}

}  // namespace
}  // namespace dhcal
