// A gear that errs at many orders at once is named as a curve of its joint, not as a heap of lines.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/problem_cases.h"
#include "tests/support/sanitized.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

/// 900 poses of an arm whose joint 3 errs at eight orders, none of them special.
Draw DrawWithCurve() {
  Scenario s;
  s.poses = 900;
  const double orders[] = {8, 11, 14, 17, 19, 23, 26, 29};
  for (int k = 0; k < 8; ++k) {
    EffectRequest line;
    line.effect = "gear_harmonic";
    line.joint = 3;
    const std::string order = std::to_string(static_cast<int>(orders[k]));
    line.settings["order"] = orders[k];
    line.values["sin_" + order] = 1.2e-4 * std::cos(1.7 * k);
    line.values["cos_" + order] = 1.2e-4 * std::sin(1.7 * k);
    s.truth.push_back(line);
  }
  return MakeDraw(s, 5);
}

TEST(ErrorCurve, IsNamedWhereAGearErrsAtManyOrders) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  const Draw draw = DrawWithCurve();
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  const auto curve = std::find_if(d.findings.begin(), d.findings.end(), [](const Finding& f) {
    return f.effect.effect == "transmission_error" && f.effect.joint == 3;
  });
  ASSERT_NE(curve, d.findings.end()) << d.summary;
  EXPECT_EQ(curve->location, "joint 3");
  // 0.3 mrad-metre of misfit beside 0.03 mm of noise, predicted where it was not fitted.
  EXPECT_LT(d.rms_test_after, 0.5 * d.rms_test_before);
  EXPECT_LT(d.rms_train_after, 1.1 * draw.spec.measurement.sigma.value());
  for (const Finding& finding : d.findings) {
    EXPECT_EQ(finding.location, "joint 3") << finding.sentence;
  }
}

TEST(ErrorCurve, AndTheZeroOfItsJointAreKnownTogetherOnly) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  Scenario s;
  s.poses = 300;
  Draw draw = MakeDraw(s, 6);
  const auto verdict_of = [&](const std::string& name) {
    const Result result = IdentifyGeometry(draw.spec, draw.recording, {});
    return ByName(*result.best())[name];
  };
  EXPECT_EQ(verdict_of("theta3").verdict, Verdict::kIdentified);
  draw.spec.parameters.effects = {Request("transmission_error", 3)};
  const ParameterResult theta3 = verdict_of("theta3");
  EXPECT_EQ(theta3.verdict, Verdict::kConfounded);
  EXPECT_EQ(theta3.confounded_with, std::vector<std::string>{"transmission_error.3"});
  EXPECT_EQ(verdict_of("theta2").verdict, Verdict::kIdentified);
}

}  // namespace
}  // namespace dhcal
