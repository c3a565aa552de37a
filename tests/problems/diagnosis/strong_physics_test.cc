// Physics far beyond what is usual: the name stands where the model breaks down without it, and no
// frame is blamed for what the physics does.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/problem_cases.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

Draw VerySoft(int joint, std::uint64_t seed) {
  Scenario scenario;
  scenario.poses = 150;
  // 150 times as soft as usual: millimetres under the arm's own weight.
  scenario.truth = {Request("joint_compliance", joint, {{"compliance", 4.5e-4}})};
  return MakeDraw(scenario, seed);
}

TEST(StrongPhysics, OfAnUnheardOfSizeIsNamedAllTheSame) {
  const Draw draw = VerySoft(3, 11);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kExplained) << d.summary;
  const bool named = std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) {
    return f.effect.effect == "joint_compliance" && f.effect.joint == 3;
  });
  EXPECT_TRUE(named) << d.summary;
}

TEST(StrongPhysics, DoesNotMakeAFrameOfTheFileLookForgotten) {
  Draw draw = VerySoft(3, 12);
  draw.spec.parameters.estimate = {"theta", "alpha", "a", "d"};
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  for (const Finding& finding : d.findings) {
    EXPECT_NE(finding.effect_class, "geometry") << finding.sentence;
  }
}

}  // namespace
}  // namespace dhcal
