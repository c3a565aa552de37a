// Physics far beyond what is usual: the name stands where the model breaks down without it, and no
// frame is blamed for what the physics does.
#include <algorithm>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/problem_cases.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

Draw Soft(double compliance, std::uint64_t seed) {
  Scenario scenario;
  scenario.ur10 = true;
  scenario.poses = 150;
  scenario.truth = {Request("joint_compliance", 3, {{"compliance", compliance}})};
  return MakeDraw(scenario, seed);
}

TEST(StrongPhysics, OfAnUnheardOfSizeIsNamedAllTheSame) {
  // 110 times as soft as usual: millimetres under the arm's own weight.
  const Draw draw = Soft(3.3e-4, 11);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  const bool named = std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) {
    return f.effect.effect == "joint_compliance" && f.effect.joint == 3;
  });
  EXPECT_TRUE(named) << d.summary;
}

TEST(StrongPhysics, DoesNotMakeAFrameOfTheFileLookForgotten) {
  Draw draw = Soft(1e-4, 12);
  draw.spec.parameters.estimate = {"theta", "alpha", "a", "d"};
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  for (const Finding& finding : d.findings) {
    // The axes of the draw do err, base and tool do not.
    EXPECT_NE(finding.location, "base") << finding.sentence;
    EXPECT_NE(finding.location, "tool") << finding.sentence;
  }
}

}  // namespace
}  // namespace dhcal
