// A step in a gap of the clock is a step, although a smooth function of time would do as well
// there.
#include <gtest/gtest.h>

#include "residuals/registry.h"
#include "tests/support/problem_cases.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

TEST(StepInAGap, IsNamedWhereverItIs) {
  for (const int after : {85, 111}) {
    SCOPED_TRACE(after);
    const TrueRobot truth = MakeTrueRobot(Kr15(), 8);
    const ProblemSpec spec =
        MakeSpec(truth.nominal, KindNamed("position"), NoiseKind::kIndependent);
    RecordingPlan plan;
    plan.poses = 222;
    Recording recording = Record(truth, spec, plan);
    recording.time.resize(plan.poses);
    for (int row = 0; row < plan.poses; ++row) {
      recording.time[row] = 15 * row + (row < after ? 0 : 2700);
      if (row >= after) recording.q(row, 3) -= 5e-3;
    }
    const DiagnosisResult d = Diagnosed(spec, recording);
    ASSERT_EQ(d.findings.size(), 1) << d.summary;
    EXPECT_EQ(d.findings[0].effect.effect, "joint_step") << d.summary;
    EXPECT_EQ(d.findings[0].effect.joint, 4);
  }
}

}  // namespace
}  // namespace dhcal
