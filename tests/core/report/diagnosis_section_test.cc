#include <cmath>
#include <limits>
#include <string>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/sections.h"
#include "core/report/text_renderer.h"
#include "tests/support/example_result.h"

namespace dhcal {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

std::string DiagnosisText(const ProblemSpec& spec, const Result& result) {
  return ToText(DiagnosisSection(spec, result));
}

/// The example with a diagnosis that found one effect.
Result WithFinding() {
  Result result = ExampleResult();
  result.diagnosis.emplace();
  DiagnosisResult& d = *result.diagnosis;
  d.verdict = DiagnosisVerdict::kAmbiguous;
  d.summary = "something";
  d.false_alarm = 0.01;
  d.misfit.rows = 100;
  d.misfit.rms = 3e-4;
  d.misfit.noise_sigma = 2e-5;
  d.misfit.p_value = 1e-12;
  d.findings.emplace_back();
  d.findings[0].effect.effect = "joint_compliance";
  d.findings[0].effect.joint = 2;
  d.findings[0].effect_class = "C1";
  d.findings[0].sentence = "joint 2 yields";
  return result;
}

ProblemSpec WithSlidingJointThree() {
  ProblemSpec spec = ExampleSpec();
  spec.robot.joints[2].type = JointType::kPrismatic;
  return spec;
}

Result WithSeparatingPose() {
  Result result = WithFinding();
  SeparatingPose pose;
  pose.q = Eigen::VectorXd::Constant(6, 10 * kDegree);
  pose.q[2] = 0.25;
  result.diagnosis->findings[0].separating_poses = {pose};
  return result;
}

Result WithCurveOver(const std::string& driver, const std::string& unit, double value) {
  Result result = WithFinding();
  Unexplained rest;
  rest.fraction = 1;
  rest.slot = "theta1";
  rest.driver = driver;
  rest.driver_unit = unit;
  rest.unit = Unit::kRadian;
  rest.curve = {{value, 1e-4, 1e-5}};
  result.diagnosis->unexplained = rest;
  return result;
}

HiddenRisk Hidden(const std::string& effect, double limit) {
  HiddenRisk risk;
  risk.effect.effect = effect;
  risk.visibility = 0.5;
  risk.limit = limit;
  risk.unit = "rad";
  return risk;
}

TEST(DiagnosisSection, AProbabilityAtTheFloorOfTheDrawsIsABound) {
  Result result = WithFinding();
  result.diagnosis->misfit.p_floor = 6e-4;
  result.diagnosis->misfit.p_value = 6e-4;
  EXPECT_THAT(DiagnosisText(ExampleSpec(), result), ContainsRegex("this:[[:space:]]+< 6.0e-04"));
  result.diagnosis->misfit.p_value = 1e-12;  // of the order scan, a bound by itself
  EXPECT_THAT(DiagnosisText(ExampleSpec(), result), HasSubstr("1.0e-12"));
}

TEST(DiagnosisSection, RowsSetAsideAreNamed) {
  Result result = WithFinding();
  result.diagnosis->misfit.outliers = 2;
  result.diagnosis->misfit.outlier_rows = {64, 92};
  EXPECT_THAT(DiagnosisText(ExampleSpec(), result), HasSubstr("65, 93"));
}

TEST(DiagnosisSection, PosesOfTurningJointsAreInDegrees) {
  Result result = WithSeparatingPose();
  result.diagnosis->findings[0].separating_poses[0].q[2] = -20 * kDegree;
  EXPECT_THAT(DiagnosisText(ExampleSpec(), result),
              HasSubstr("pose: 10.0, 10.0, -20.0, 10.0, 10.0, 10.0 deg\n"));
}

TEST(DiagnosisSection, SlidingJointsOfAPoseAreInMillimetres) {
  EXPECT_THAT(DiagnosisText(WithSlidingJointThree(), WithSeparatingPose()),
              HasSubstr("pose: 10.0 deg, 10.0 deg, 250.0 mm, 10.0 deg, 10.0 deg, 10.0 deg\n"));
}

TEST(DiagnosisSection, ACurveOverATurningJointIsInDegrees) {
  const std::string text =
      DiagnosisText(WithSlidingJointThree(), WithCurveOver("q2", "rad", 30 * kDegree));
  EXPECT_THAT(text, ContainsRegex("\\[deg\\] +\\[mrad\\] +\\[mrad\\]\n +30\\.0 +0\\.100"));
}

TEST(DiagnosisSection, ACurveOverASlidingJointIsInMillimetres) {
  const std::string text = DiagnosisText(WithSlidingJointThree(), WithCurveOver("q3", "m", 0.25));
  EXPECT_THAT(text, ContainsRegex("\\[mm\\] +\\[mrad\\] +\\[mrad\\]\n +250\\.0 +0\\.100"));
}

TEST(DiagnosisSection, ACurveOverAnythingElseStandsAsItIs) {
  const std::string text = DiagnosisText(ExampleSpec(), WithCurveOver("quality", "", 7));
  EXPECT_THAT(text, ContainsRegex("\n +7\\.0 +0\\.100"));
  EXPECT_THAT(text, Not(HasSubstr("[deg]")));
  EXPECT_THAT(DiagnosisText(ExampleSpec(), WithCurveOver("time", "s", 7)),
              ContainsRegex("\\[s\\] +\\[mrad\\] +\\[mrad\\]\n +7\\.0 +0\\.100"));
}

TEST(DiagnosisSection, DrawsTheCurveThatItPrints) {
  const Section section = DiagnosisSection(ExampleSpec(), WithCurveOver("q2", "rad", 30 * kDegree));
  const Figure* figure = nullptr;
  for (const Block& block : section.blocks) {
    if (std::holds_alternative<Figure>(block)) figure = &std::get<Figure>(block);
  }
  ASSERT_NE(figure, nullptr);
  ASSERT_EQ(figure->plots.size(), 1u);
  const Plot& plot = figure->plots[0];
  EXPECT_EQ(plot.x.unit, "deg");
  EXPECT_EQ(plot.y.unit, "mrad");
  ASSERT_EQ(plot.series.size(), 1u);
  EXPECT_THAT(plot.series[0].x, testing::ElementsAre(testing::DoubleNear(30, 1e-12)));
  EXPECT_THAT(plot.series[0].y, testing::ElementsAre(testing::DoubleNear(0.1, 1e-12)));
  EXPECT_THAT(plot.series[0].sigma, testing::ElementsAre(testing::DoubleNear(0.01, 1e-12)));
}

TEST(DiagnosisSection, NumbersThatAreNotKnownAreNotPrinted) {
  Result result = WithFinding();
  DiagnosisResult& d = *result.diagnosis;
  d.findings[0].effect_class = "geometry";
  d.validation_method = "set column";
  d.rms_test_before = 4e-4;
  d.rms_test_after = 3e-5;
  const std::string text = DiagnosisText(ExampleSpec(), result);
  EXPECT_THAT(text, Not(HasSubstr("not known")));
  EXPECT_THAT(text, Not(HasSubstr("All together")));
  // 3-D: the root of three times what one coordinate has.
  EXPECT_THAT(
      text,
      HasSubstr("Complete geometry: 0.05196 mm instead of 0.6928 mm on rows not fitted (set "
                "column) (RMS, 3-D)."));
  d.rms_train_before = 5e-4;
  d.rms_train_after = 2e-5;
  EXPECT_THAT(DiagnosisText(ExampleSpec(), result),
              HasSubstr("All together: 0.03464 mm instead of 0.8660 mm on fitted rows,"));
}

TEST(DiagnosisSection, SaysOnlyThatTheCompleteGeometryHasNoFit) {
  Result result = ExampleResult();
  result.diagnosis.emplace();
  result.diagnosis->verdict = DiagnosisVerdict::kUnexplained;
  result.diagnosis->summary = "the complete geometry could not be fitted";
  result.diagnosis->false_alarm = 0.01;
  EXPECT_EQ(DiagnosisText(ExampleSpec(), result),
            "\nUNMODELLED EFFECTS: UNEXPLAINED\n\n"
            "  The complete geometry could not be fitted.\n");
}

TEST(DiagnosisSection, LimitsThatSayNothingAreLeftOut) {
  Result result = WithFinding();
  result.diagnosis->hidden = {Hidden("base_drift", 0),
                              Hidden("tool_step", std::numeric_limits<double>::infinity()),
                              Hidden("backlash", 2e-5),
                              Hidden("sensor_scale", kUnknown)};
  const std::string text = DiagnosisText(ExampleSpec(), result);
  EXPECT_THAT(text, Not(HasSubstr("base_drift")));
  EXPECT_THAT(text, Not(HasSubstr("tool_step")));
  EXPECT_THAT(text, ContainsRegex("backlash +0\\.500 +2\\.0e-05"));
  EXPECT_THAT(text, ContainsRegex("sensor_scale +0\\.500 +never"));
  result.diagnosis->hidden.resize(2);
  EXPECT_THAT(DiagnosisText(ExampleSpec(), result), Not(HasSubstr("could still be hidden")));
}

}  // namespace
}  // namespace dhcal
