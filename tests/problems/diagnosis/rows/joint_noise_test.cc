// Noise of the joints is told from noise of the instrument, and rounding that is not there from one
// that is.
#include "problems/diagnosis/rows/joint_noise.h"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "residuals/registry.h"
#include "tests/support/problem_cases.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kDrawn = 200, kDrawnJoints = 6;

/// Readings of three coordinates in standard deviations; levers of up to `lever` per radian, each
/// reading its own.
struct NoisyRows {
  MatrixXd J;
  VectorXd y;
};

NoisyRows DrawRows(std::uint64_t seed, double lever, double joint_sigma) {
  Rng rng(seed);
  NoisyRows rows{MatrixXd(3 * kDrawn, kDrawnJoints), VectorXd(3 * kDrawn)};
  for (double& value : rows.y) value = rng.Normal();
  for (int k = 0; k < kDrawn; ++k) {
    const double own_lever = lever * rng.Uniform(0.1, 1);
    for (double& value : rows.J.middleRows(3 * k, 3).reshaped()) {
      value = own_lever * rng.Uniform(-1, 1);
    }
    VectorXd off(kDrawnJoints);
    for (double& value : off) value = joint_sigma * rng.Normal();
    rows.y.segment(3 * k, 3) += rows.J.middleRows(3 * k, 3) * off;
  }
  return rows;
}

TEST(FindJointNoise, ItsSigmaAndTheRestAreFound) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const NoisyRows rows = DrawRows(seed, 1e5, 2e-5);
    const LikeliestJointNoise found = FindJointNoise(rows.y, rows.J, 3);
    EXPECT_GT(found.evidence, 14);
    EXPECT_NEAR(found.sigma, 2e-5, 0.4e-5);
    EXPECT_NEAR(found.rest, 1, 0.7);
  }
}

TEST(FindJointNoise, WhiteNoiseHasNone) {
  for (std::uint64_t seed = 101; seed <= 300; ++seed) {
    const NoisyRows rows = DrawRows(seed, 1e5, 0);
    EXPECT_LT(FindJointNoise(rows.y, rows.J, 3).evidence, 14) << seed;
  }
}

TEST(EvidenceOfCovariance, IsForWhatIsThereAndAgainstWhatIsNot) {
  for (std::uint64_t seed = 401; seed <= 420; ++seed) {
    SCOPED_TRACE(seed);
    const NoisyRows with = DrawRows(seed, 1e5, 3e-5), without = DrawRows(seed, 1e5, 0);
    EXPECT_GT(EvidenceOfCovariance(with.y, 3e-5 * with.J, 3), 14);
    EXPECT_LT(EvidenceOfCovariance(without.y, 3e-5 * without.J, 3), -14);
  }
}

/// A clean recording of an arm that stands 30 urad (one sigma) beside each angle of its file.
TEST(JointNoise, IsNothingLeftOut) {
  int taken_for_such = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const TrueRobot truth = MakeTrueRobot(Kr15(), seed);
    const ProblemSpec spec =
        MakeSpec(truth.nominal, KindNamed("position"), NoiseKind::kIndependent);
    RecordingPlan plan;
    plan.seed = seed;
    Recording recording = Record(truth, spec, plan);
    Rng rng(seed + 50);
    for (double& value : recording.q.reshaped()) value += 30e-6 * rng.Normal();
    const DiagnosisResult d = Diagnosed(spec, recording);
    EXPECT_TRUE(d.findings.empty()) << d.summary;
    for (const std::string& note : d.notes) {
      if (note.find("noise of the joints") != std::string::npos) ++taken_for_such;
    }
  }
  EXPECT_GE(taken_for_such, 2);
}

/// Poses in steps of 2.5 and 3.2 deg look as if they had been read to 0.1 deg.
TEST(Rounding, OfCommandedAnglesIsNone) {
  const ProblemSpec spec = LoadCase("kr15_noisy");
  const DiagnosisResult d = Diagnosed(spec, RecordingOf(spec));
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kConsistent) << d.summary;
  EXPECT_TRUE(d.misfit.noise_known) << d.misfit.why_estimated;
}

}  // namespace
}  // namespace dhcal
