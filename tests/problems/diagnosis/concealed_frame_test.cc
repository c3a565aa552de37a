// A frame that the file leaves out and that its own parameters imitate with corrections that no
// manufacture has.
#include "problems/diagnosis/concealed_frame.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "problems/diagnosis/diagnose.h"
#include "problems/identify.h"
#include "tests/support/problem_cases.h"
#include "tests/support/sanitized.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

using testing::Contains;
using testing::HasSubstr;

const FoundParameter* FindParameter(const Finding& finding, const std::string& name) {
  for (const FoundParameter& p : finding.parameters) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

/// A draw of the study, its file with plain DH rows only.
Draw PlainDraw(std::uint64_t seed) {
  Draw draw = MakeDraw(Scenario(), seed);
  draw.spec.parameters.estimate = {"theta", "alpha", "a", "d"};
  return draw;
}

/// Findings and notes of the step alone.
DiagnosisResult Concealed(const ProblemSpec& spec, const Recording& recording) {
  const auto complete = FitComplete(spec, recording, {}, {});
  const auto missing = MissingCompletions(Calibration(spec, recording), complete->calibration);
  return ConcealedFrames(
      spec, recording, IdentifyGeometry(spec, recording, {}), *complete, missing);
}

struct PaperCase {
  std::string name;
  TruncationRule rule;
  double noise;  // [m]
};

class PaperTool : public testing::TestWithParam<PaperCase> {};

TEST_P(PaperTool, ThatTheTablesDoNotPrintIsFound) {
  ProblemSpec with_tool = LoadCase("kr15");
  with_tool.simulate->noise = GetParam().noise;
  const Recording recording = RecordingOf(with_tool);
  ProblemSpec printed = LoadCase("kr15_as_printed");
  printed.solver.rule = GetParam().rule;
  const Result result = IdentifyGeometry(printed, recording, {});
  ASSERT_TRUE(WantsDiagnosis(printed, result)) << "also where the simulation has no noise";

  const DiagnosisResult d = Diagnose(printed, recording, result, {});
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kExplained) << d.summary;
  ASSERT_EQ(d.findings.size(), 1) << d.summary;
  const Finding& f = d.findings[0];
  EXPECT_EQ(f.effect.effect, "tool_offset");
  EXPECT_EQ(f.effect_class, "geometry");
  EXPECT_EQ(f.location, "tool");
  const FoundParameter* const z = FindParameter(f, "tool_offset.z");
  ASSERT_NE(z, nullptr);
  EXPECT_EQ(z->unit, "m");
  EXPECT_NEAR(z->value, 0.2, 2 * z->sigma);
  // d6 is one direction with it: known no better than d6's tolerance of 0.5 mm.
  EXPECT_GT(z->sigma, 0.3e-3);
  EXPECT_LT(z->sigma, 0.6e-3);
  EXPECT_THAT(f.sentence, HasSubstr("+- 0.50 mm"));
  EXPECT_GT(f.rms_train_before, 0.1);
  EXPECT_LT(f.rms_train_after, 0.02e-3);
  EXPECT_THAT(f.cautions, Contains(HasSubstr("d6 by +")));
  EXPECT_THAT(f.cautions, Contains(HasSubstr("cannot tell d6 from tool_z")));
  ASSERT_FALSE(d.moved.empty());
  EXPECT_EQ(d.moved[0].name, "d6");
  EXPECT_LT(std::abs(d.moved[0].after), 0.5e-3);
  EXPECT_EQ(d.misfit.outliers, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Paper,
    PaperTool,
    testing::Values(PaperCase{"PaperRuleNoiseFree", TruncationRule::kPaper, 0},
                    PaperCase{"PaperRuleNoisy", TruncationRule::kPaper, 0.02e-3},
                    PaperCase{"NoiseRuleNoiseFree", TruncationRule::kNoise, 0},
                    PaperCase{"NoiseRuleNoisy", TruncationRule::kNoise, 0.02e-3}),
    [](const auto& param) { return param.param.name; });

TEST(ConcealedFrame, WithoutTheMistakeThePaperIsNotDiagnosed) {
  for (const char* const name : {"kr15", "kr15_as_printed"}) {
    const ProblemSpec spec = LoadCase(name);
    EXPECT_FALSE(WantsDiagnosis(spec, RunCase(spec))) << name;
  }
}

TEST(ConcealedFrame, UsualErrorsAreNeverOne) {
  const std::uint64_t most = kSanitized ? 10 : 60;
  for (std::uint64_t seed = 1; seed <= most; ++seed) {
    const Draw draw = PlainDraw(seed);
    const DiagnosisResult d = Concealed(draw.spec, draw.recording);
    EXPECT_TRUE(d.findings.empty()) << "seed " << seed;
    EXPECT_TRUE(d.notes.empty()) << "seed " << seed << ": " << d.notes.front();
  }
}

TEST(ConcealedFrame, AToolForgottenSidewaysIsFoundAlongEitherAxis) {
  for (const int axis : {0, 1}) {
    Draw draw = PlainDraw(7);
    draw.spec.robot.X_TQ.translation()[axis] -= 0.03;
    const DiagnosisResult d = Concealed(draw.spec, draw.recording);
    ASSERT_EQ(d.findings.size(), 1) << "axis " << axis;
    EXPECT_EQ(d.findings[0].effect.effect, "tool_offset");
    const FoundParameter* const p =
        FindParameter(d.findings[0], axis == 0 ? "tool_offset.x" : "tool_offset.y");
    ASSERT_NE(p, nullptr);
    EXPECT_NEAR(p->value, 0.03, 4 * p->sigma);
    EXPECT_LT(p->sigma, 1e-3);
  }
}

TEST(ConcealedFrame, AForgottenBaseIsFound) {
  Draw draw = PlainDraw(8);
  draw.spec.robot.X_WB.translation() -= Eigen::Vector3d(0, 0, 0.4);
  const DiagnosisResult d = Concealed(draw.spec, draw.recording);
  ASSERT_EQ(d.findings.size(), 1);
  EXPECT_EQ(d.findings[0].effect.effect, "base_frame");
  const FoundParameter* const z = FindParameter(d.findings[0], "base_frame.z");
  ASSERT_NE(z, nullptr);
  EXPECT_NEAR(z->value, 0.4, 4 * z->sigma);
  EXPECT_THAT(d.findings[0].cautions, Contains(HasSubstr("cannot tell d1 from base_z")));
}

TEST(ConcealedFrame, AToolWrongByLittleIsLeftToTheRowsThatImitateIt) {
  Draw draw = PlainDraw(9);
  draw.spec.robot.X_TQ.translation().z() -= 2e-3;
  EXPECT_TRUE(Concealed(draw.spec, draw.recording).findings.empty());
}

TEST(ConcealedFrame, AToolThatIsEstimatedMayBeWrongAsItLikes) {
  Draw draw = MakeDraw(Scenario(), 10);
  draw.spec.robot.X_TQ.translation().z() -= 2e-3;
  const Result result = IdentifyGeometry(draw.spec, draw.recording, {});
  const DiagnosisResult d = Diagnose(draw.spec, draw.recording, result, {});
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kConsistent) << d.summary;
  EXPECT_TRUE(d.findings.empty());
}

TEST(ConcealedFrame, AWrongDrawingLengthIsNoFrame) {
  Draw draw = PlainDraw(11);
  draw.spec.robot.joints[1].a -= 0.03;
  const DiagnosisResult d = Concealed(draw.spec, draw.recording);
  EXPECT_TRUE(d.findings.empty());
  EXPECT_THAT(d.notes, Contains(HasSubstr("a2 by +")));
}

TEST(ConcealedFrame, APriorThatTheFileGivesIsTheTolerance) {
  Draw draw = PlainDraw(12);
  draw.spec.robot.X_TQ.translation().z() -= 0.03;
  draw.spec.parameters.prior_sigma["d6"] = 0.1;
  EXPECT_TRUE(Concealed(draw.spec, draw.recording).findings.empty())
      << "the file says that d6 may be anything";
}

}  // namespace
}  // namespace dhcal
