// A tooth of one joint's gear is damaged: a few readings lie far off, all where the joint stands at
// it. They look like misreadings, and are the only trace of the damage.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/problem_cases.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

constexpr double kDent = 0.6e-3;           // [rad]
constexpr double kAt = 0.3, kWide = 0.09;  // [rad]
constexpr int kJoint = 2;

/// Positions of an arm whose joint 3 turns too far while it stands at the tooth.
Recording WithTooth(const TrueRobot& truth, const ProblemSpec& spec, std::uint64_t seed) {
  RecordingPlan plan;
  plan.poses = 200;
  plan.seed = seed;
  Recording recording = Record(truth, spec, plan);
  for (int row = 0; row < plan.poses; ++row) {
    Eigen::VectorXd q = recording.q.row(row).transpose();
    if (std::abs(q[kJoint] - kAt) > kWide) continue;
    const Eigen::Vector3d before = truth.Pose(q).topRightCorner<3, 1>();
    q[kJoint] += kDent;
    recording.p_WQ.row(row) += (truth.Pose(q).topRightCorner<3, 1>() - before).transpose();
  }
  return recording;
}

TEST(DamagedTooth, IsNotSetAsideAsMisreadings) {
  int unnoticed = 0, elsewhere = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const TrueRobot truth = MakeTrueRobot(Kr15(), seed);
    const ProblemSpec spec =
        MakeSpec(truth.nominal, KindNamed("position"), NoiseKind::kIndependent);
    const DiagnosisResult d = Diagnosed(spec, WithTooth(truth, spec, seed));
    if (d.verdict == DiagnosisVerdict::kConsistent) ++unnoticed;
    for (const Finding& finding : d.findings) {
      const bool at_joint = finding.location == "joint 3";
      if (!at_joint) ++elsewhere;
      EXPECT_TRUE(at_joint) << seed << ": " << finding.location << ": " << finding.sentence;
    }
  }
  EXPECT_EQ(unnoticed, 0);
  EXPECT_EQ(elsewhere, 0);
}

}  // namespace
}  // namespace dhcal
