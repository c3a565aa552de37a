// The refit judges what named effects leave in the units of each kind of reading.
#include "problems/diagnosis/refit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "residuals/registry.h"
#include "tests/support/problem_cases.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

/// A KR 15 of which joint 2 yields, read in another way.
ProblemSpec YieldingJoint(const MeasurementKind& kind, NoiseKind noise) {
  ProblemSpec spec = LoadCase("kr15_left_out");
  spec.simulate->effects.resize(1);
  spec.measurement.kind = kind;
  spec.measurement.noise = noise;
  if (kind.name == "pose") {
    spec.simulate->noise_rotation = 5e-5;
    spec.measurement.sigma_rotation = 5e-5;
  }
  return spec;
}

void ExpectOnlyTheYieldingJoint(const DiagnosisResult& d) {
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kExplained) << d.summary;
  ASSERT_EQ(d.findings.size(), 1) << d.summary;
  EXPECT_TRUE(d.findings[0].effect.SameAs(Request("joint_compliance", 2)));
  const FoundParameter& p = d.findings[0].parameters[0];
  EXPECT_NEAR(p.value, 3e-6, 4 * p.sigma);
}

TEST(Refit, PosesAreJudgedByBothTheirNoises) {
  const ProblemSpec spec = YieldingJoint(KindNamed("pose"), NoiseKind::kIndependent);
  ExpectOnlyTheYieldingJoint(Diagnosed(spec, RecordingOf(spec)));
}

TEST(Refit, DifferencesOfSharedReadingsAreJudgedByTheReadingsNoise) {
  const ProblemSpec spec = YieldingJoint(KindNamed("adjacent_position"), NoiseKind::kSharedPose);
  ExpectOnlyTheYieldingJoint(Diagnosed(spec, RecordingOf(spec)));
}

TEST(Refit, AWithdrawnModelLeavesNoTotals) {
  const Draw draw = MakeDraw(Scenario(), 3);
  const Calibration c(draw.spec, draw.recording);
  DiagnosisResult d;
  const Refitted refitted = RefitAndJudge(
      draw.spec, draw.recording, c.readings.fitted, {Request("joint_gain", 3)}, [](auto&) {}, &d);
  ASSERT_EQ(refitted.fit, nullptr) << "there is no such effect";
  EXPECT_TRUE(refitted.rest_left);
  EXPECT_TRUE(d.findings.empty());
  EXPECT_TRUE(std::isnan(d.rms_train_after));
  EXPECT_TRUE(std::isnan(d.rms_test_after));
  EXPECT_EQ(d.validation_method, "");
}

TEST(Refit, AnEffectThatTheFileSwitchesOnIsNeitherFoundAgainNorARisk) {
  ProblemSpec spec = YieldingJoint(KindNamed("position"), NoiseKind::kIndependent);
  spec.parameters.effects = {Request("joint_compliance", 2)};
  const DiagnosisResult d = Diagnosed(spec, RecordingOf(spec));
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kConsistent) << d.summary;
  ASSERT_FALSE(d.hidden.empty());
  for (const HiddenRisk& risk : d.hidden) {
    // Metres: what an unseen effect of a usual size may cause.
    EXPECT_FALSE(risk.risk > 0.02) << InstanceName(risk.effect) << " " << risk.risk;
  }
}

}  // namespace
}  // namespace dhcal
