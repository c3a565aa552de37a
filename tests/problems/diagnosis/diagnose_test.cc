// The whole diagnosis on recordings whose answer is known. Rates over many draws: dhcal_study.
#include "problems/diagnosis/diagnose.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/physics/registry.h"
#include "problems/identify.h"
#include "tests/support/problem_cases.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"
#include "tests/support/sanitized.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

Scenario With(const EffectRequest& effect) {
  Scenario scenario;
  scenario.truth = {effect};
  return scenario;
}

TEST(Diagnose, CleanDataIsConsistentWithLimitsAndRisks) {
  const Draw draw = MakeDraw(Scenario(), 1);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kConsistent);
  EXPECT_TRUE(d.findings.empty());
  EXPECT_GT(d.misfit.p_value, 0.01);
  ASSERT_FALSE(d.hidden.empty());
  for (const HiddenRisk& risk : d.hidden) {
    EXPECT_GE(risk.visibility, 0);
    EXPECT_LE(risk.visibility, 1.0 + 1e-9) << InstanceName(risk.effect);
  }
}

TEST(Diagnose, TheMapIsWhole) {
  const Draw draw = MakeDraw(With(Request("joint_compliance", 2, {{"compliance", 3e-6}})), 1);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  // Six joints' slots, base and tool: six angles each, and more.
  EXPECT_GE(d.map.size(), 48);
}

TEST(Diagnose, ThePartNotExplainedIsThatOfTheTwoRmsAboveTheNoise) {
  Scenario scenario = With(Request("joint_compliance", 2, {{"compliance", 3e-6}}));
  scenario.outside = [](const PhysicsContext& c, int row, Eigen::VectorXd* delta) {
    const double x = (c.recording().q(row, 2) / kDegree - 15) / 10;
    (*delta)[c.slots().joint(4, JointSlot::kTheta)] += 0.6e-3 * std::exp(-0.5 * x * x);
  };
  const Draw draw = MakeDraw(scenario, 8);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  ASSERT_EQ(d.verdict, DiagnosisVerdict::kPartlyExplained) << d.summary;
  ASSERT_TRUE(d.unexplained.has_value());
  const double noise = std::pow(draw.spec.measurement.sigma.value(), 2);
  const double before = std::pow(d.rms_train_before, 2), after = std::pow(d.rms_train_after, 2);
  EXPECT_NEAR(d.unexplained->fraction, (after - noise) / (before - noise), 1e-9);
  EXPECT_NEAR(d.unexplained->rms, std::sqrt(after - noise), 1e-12);
}

TEST(Diagnose, ScaleIsNeverVisible) {
  const Draw draw = MakeDraw(Scenario(), 2);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  const auto scale = std::find_if(d.hidden.begin(), d.hidden.end(), [](const HiddenRisk& r) {
    return r.effect.effect == "sensor_scale";
  });
  ASSERT_NE(scale, d.hidden.end());
  EXPECT_LT(scale->visibility, 1e-3);
  EXPECT_TRUE(std::isnan(scale->limit)) << "no amount of it can be found";
}

TEST(Diagnose, NamesLocatesAndSizesComplianceAndImprovesUnseenRows) {
  const Draw draw = MakeDraw(With(Request("joint_compliance", 2, {{"compliance", 3e-6}})), 1);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  ASSERT_EQ(d.verdict, DiagnosisVerdict::kExplained) << d.summary;
  ASSERT_EQ(d.findings.size(), 1);
  const Finding& f = d.findings[0];
  EXPECT_EQ(f.effect.effect, "joint_compliance");
  EXPECT_EQ(f.location, "joint 2");
  EXPECT_EQ(f.effect_class, "C1");
  ASSERT_EQ(f.parameters.size(), 1);
  EXPECT_EQ(f.parameters[0].name, "joint_compliance.2.compliance");
  EXPECT_NEAR(f.parameters[0].value, 3e-6, 4 * f.parameters[0].sigma);
  EXPECT_LT(f.parameters[0].sigma, 0.1e-6);
  EXPECT_THAT(f.sentence, HasSubstr("joint 2 is compliant"));
  EXPECT_LT(f.rms_test_after, 0.3 * f.rms_test_before);
  EXPECT_LT(f.rms_test_after, 1.3 * draw.spec.measurement.sigma.value());
  EXPECT_GT(f.delta_bic, 100);
  EXPECT_FALSE(d.moved.empty()) << "the geometry had swallowed part of it";
}

TEST(Diagnose, WithoutMassesComplianceIsStillFound) {
  Draw draw = MakeDraw(With(Request("joint_compliance", 2, {{"compliance", 3e-6}})), 3);
  draw.spec.robot.links.clear();
  draw.spec.robot.payload = LinkMass();
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  bool found = false;
  for (const Finding& f : d.findings)
    found = found || f.effect.SameAs([] {
      EffectRequest request;
      request.effect = "joint_compliance";
      request.joint = 2;
      return request;
    }());
  EXPECT_TRUE(found) << d.summary;
}

TEST(Diagnose, ANegativeComplianceIsNoName) {
  EffectRequest reversed = Request("joint_compliance", 2, {{"compliance", 3e-6}});
  reversed.values["compliance"] = -3e-6;
  const Draw draw = MakeDraw(With(reversed), 4);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  EXPECT_NE(d.verdict, DiagnosisVerdict::kConsistent) << d.summary;
  for (const Finding& f : d.findings) {
    EXPECT_FALSE(f.effect.SameAs(Request("joint_compliance", 2))) << d.summary;
  }
}

TEST(Diagnose, FindsAMeshOrderThatItWasNotTold) {
  EffectRequest line;
  line.effect = "gear_harmonic";
  line.joint = 3;
  line.settings["order"] = 125;
  line.values["sin_125"] = 1e-4;
  const Draw draw = MakeDraw(With(line), 5);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  ASSERT_EQ(d.findings.size(), 1) << d.summary;
  EXPECT_EQ(d.findings[0].effect.effect, "gear_harmonic");
  EXPECT_EQ(d.findings[0].effect.joint, 3);
  EXPECT_NEAR(d.findings[0].effect.setting("order", 0), 125, 0.15);
}

TEST(Diagnose, FindsALowOrderThatIsNeitherOnceNorTwicePerTurn) {
  const Draw draw =
      MakeDraw(With(Request("gear_harmonic", 2, {{"cos_5", 1e-4}}, {{"order", 5}})), 5);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  ASSERT_EQ(d.findings.size(), 1) << d.summary;
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kExplained);
  EXPECT_EQ(d.findings[0].effect.effect, "gear_harmonic");
  EXPECT_EQ(d.findings[0].effect.joint, 2);
  EXPECT_EQ(d.findings[0].effect.setting("order", 0), 5);
}

TEST(Diagnose, AMissingTiltIsNamedAsGeometry) {
  Scenario tilted;
  tilted.truth.resize(1);
  tilted.truth[0].effect = "axis_tilt";
  tilted.truth[0].joint = 2;
  tilted.truth[0].values["tilt"] = 1.5e-3;  // a draw's own is 0.4 mrad on average
  const Draw draw = MakeDraw(tilted, 6);
  ProblemSpec spec = draw.spec;
  spec.parameters.estimate = {"theta", "alpha", "a", "d", "base", "tool"};
  const DiagnosisResult d = Diagnosed(spec, draw.recording);
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kExplained) << d.summary;
  ASSERT_EQ(d.findings.size(), 1);
  EXPECT_EQ(d.findings[0].effect.effect, "axis_tilt");
  EXPECT_EQ(d.findings[0].effect.joint, 2);
  EXPECT_EQ(d.findings[0].effect_class, "geometry");
}

TEST(Diagnose, AWrongToolIsNamedAsGeometry) {
  const Draw draw = MakeDraw(Scenario(), 7);
  ProblemSpec spec = draw.spec;
  // The last row's lengths would do as well as the tool: without them it is missed.
  spec.parameters.estimate = {"theta", "alpha", "a", "d", "beta2", "base"};
  spec.parameters.fix = {"a6", "d6"};
  spec.robot.X_TQ.translation().x() += 2e-3;
  const DiagnosisResult d = Diagnosed(spec, draw.recording);
  ASSERT_EQ(d.findings.size(), 1) << d.summary;
  EXPECT_EQ(d.findings[0].effect.effect, "tool_offset");
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kExplained);
}

TEST(Diagnose, SomethingOutsideTheLibraryIsLocatedNotNamed) {
  Scenario scenario;
  scenario.outside = [](const PhysicsContext& c, int row, Eigen::VectorXd* delta) {
    const double x = (c.recording().q(row, 2) / kDegree - 15) / 10;
    (*delta)[c.slots().joint(4, JointSlot::kTheta)] += 0.6e-3 * std::exp(-0.5 * x * x);
  };
  const Draw draw = MakeDraw(scenario, 8);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kUnexplained) << d.summary;
  ASSERT_TRUE(d.unexplained.has_value());
  EXPECT_EQ(d.unexplained->slot, "theta5");
  EXPECT_EQ(d.unexplained->driver, "q3");
  EXPECT_GE(d.unexplained->curve.size(), 5);
}

TEST(Diagnose, AnUnknownColumnThatActsByNoStraightLineIsTheDriverOfSomethingUnnamed) {
  Draw draw = MakeDraw(Scenario(), 9);
  // A load cell that nobody told the program about turns joint 1, to both sides of 50 alike.
  ExtraColumn column;
  column.name = "load_cell";
  column.values.resize(draw.recording.num_rows());
  Rng rng(99);
  const DhChain chain(draw.spec.robot);
  PoseWithDerivatives pose;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(chain.slots().size());
  for (int k = 0; k < draw.recording.num_rows(); ++k) {
    column.values[k] = rng.Uniform(0, 100);
    chain.PoseAndDerivatives(draw.recording.q.row(k).transpose(),
                             zero,
                             {draw.spec.robot.X_WB, draw.spec.robot.X_TQ},
                             &pose);
    const double turn = 1e-7 * std::pow(column.values[k] - 50, 2);
    draw.recording.p_WQ.row(k) += turn * pose.J_p.col(0).transpose();
  }
  draw.recording.extra.push_back(column);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kUnexplained) << d.summary;
  ASSERT_TRUE(d.unexplained.has_value());
  EXPECT_EQ(d.unexplained->driver, "column load_cell");
  EXPECT_EQ(d.unexplained->slot, "theta1");
}

TEST(Diagnose, TheOrderOfTheRowsDoesNotMatterWhereNothingDependsOnIt) {
  const Draw draw = MakeDraw(With(Request("joint_compliance", 2, {{"compliance", 3e-6}})), 10);
  Recording reversed = draw.recording;
  reversed.q = draw.recording.q.colwise().reverse();
  reversed.p_WQ = draw.recording.p_WQ.colwise().reverse();
  const DiagnosisResult a = Diagnosed(draw.spec, draw.recording);
  const DiagnosisResult b = Diagnosed(draw.spec, reversed);
  EXPECT_EQ(a.verdict, b.verdict);
  ASSERT_EQ(a.findings.size(), b.findings.size());
  EXPECT_NEAR(a.findings[0].parameters[0].value,
              b.findings[0].parameters[0].value,
              1e-3 * a.findings[0].parameters[0].sigma);
}

TEST(Diagnose, SeriallyCorrelatedNoiseIsNoDriftAndNoStep) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  // AR(1) noise of rho 0.6: as white noise it would be rejected at once.
  int accused = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Draw draw = MakeDraw(Scenario(), 40 + seed);
    draw.spec.measurement.sigma.reset();
    Rng rng(seed);
    Eigen::RowVector3d error = Eigen::RowVector3d::Zero();
    for (int k = 0; k < draw.recording.num_rows(); ++k) {
      const Eigen::RowVector3d fresh(rng.Normal(), rng.Normal(), rng.Normal());
      error = 0.6 * error + 0.8 * 0.1e-3 * fresh;
      draw.recording.p_WQ.row(k) += error;
    }
    const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
    accused += d.verdict == DiagnosisVerdict::kConsistent ? 0 : 1;
  }
  EXPECT_LE(accused, 1);
}

// Its column once held what was measured, and so the residual itself: it accused every such robot.
TEST(Diagnose, WhatMayNotBeNamedDoesNotAccuse) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Scenario coarse;
    coarse.sigma = 3e-3;  // of a robot of 2 m reach
    const Draw draw = MakeDraw(coarse, seed);
    const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
    EXPECT_EQ(d.verdict, DiagnosisVerdict::kConsistent) << seed << ": " << d.summary;
  }
}

TEST(WantsDiagnosis, NotOfSimulationsWithoutNoise) {
  ProblemSpec spec;
  Result result;
  result.fits.emplace_back();
  result.best_fit = 0;
  result.fits[0].rms = 1e-12;
  EXPECT_FALSE(WantsDiagnosis(spec, result));
  result.fits[0].rms = 1e-5;
  EXPECT_TRUE(WantsDiagnosis(spec, result));
  spec.diagnosis.run = DiagnosisRun::kNever;
  EXPECT_FALSE(WantsDiagnosis(spec, result));
}

TEST(WantsDiagnosis, WhereTheAnswerIsMissingOrNoManufactureExplainsIt) {
  ProblemSpec spec;
  spec.robot = Kr15();
  Result result;
  EXPECT_TRUE(WantsDiagnosis(spec, result)) << "no usable fit";
  result.fits.emplace_back();
  result.best_fit = 0;
  result.fits[0].rms = 1e-12;
  result.calibrated = spec.robot;
  EXPECT_FALSE(WantsDiagnosis(spec, result));
  result.calibrated.joints[5].d += 6e-3;
  EXPECT_TRUE(WantsDiagnosis(spec, result));
  spec.diagnosis.run = DiagnosisRun::kNever;
  EXPECT_FALSE(WantsDiagnosis(spec, result));
}

/// Every effect of the library, several times its usual size, on a recording with all columns.
class OwnData : public testing::TestWithParam<const Effect*> {};

TEST_P(OwnData, IsNamedOrListedAndRecoveredWithinItsInterval) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  constexpr double kSizes = 3;  // usual sizes
  const Effect& effect = *GetParam();
  const std::string name = effect.Describe().name;
  Scenario scenario;
  scenario.poses = 150;
  Draw draw = MakeDraw(scenario, 20);
  Recording& recording = draw.recording;
  const int n = recording.num_rows();
  Rng rng(21);
  recording.time.resize(n);
  recording.temperature.resize(n, 1);
  recording.speed.resize(n, 6);
  recording.torque.resize(n, 6);
  for (int k = 0; k < n; ++k) {
    recording.time[k] = 60.0 * k;
    recording.temperature(k, 0) = 20 + rng.Uniform(0, 10);
    for (int j = 0; j < 6; ++j) {
      recording.speed(k, j) = rng.Uniform(-0.5, 0.5);
      recording.torque(k, j) = rng.Uniform(-100, 100);
    }
  }
  ExtraColumn extra{"motor_temp", Eigen::VectorXd(n)};
  for (double& value : extra.values) value = rng.Uniform(30, 50);
  recording.extra = {extra};
  // Where there are runs, drifts begin anew with each: only what needs them has them.
  if (name.find("_per_run") != std::string::npos) {
    recording.run_names = {"one", "two"};
    for (int k = 0; k < n; ++k) recording.run_idx.push_back(2 * k < n ? 0 : 1);
  }
  const PhysicsContext context(draw.spec.robot, recording, {draw.spec.robot.X_WB});
  EffectRequest request;
  for (const EffectRequest& candidate : effect.Candidates(context)) {
    if (!effect.NotTestable(context, candidate).empty()) continue;
    request = candidate;
    if (candidate.joint >= 2 || candidate.word("slot") == "theta2") break;
  }
  ASSERT_EQ(request.effect, name);
  const DhChain chain(draw.spec.robot);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(chain.slots().size());
  const auto columns = effect.Columns(context, request);
  const EndFrames ends{draw.spec.robot.X_WB, draw.spec.robot.X_TQ};
  for (int k = 0; k < n; ++k) {
    Eigen::VectorXd delta = zero;
    for (const EffectColumn& column : columns) {
      for (const SlotWeights& weights : column.slots) {
        delta[weights.slot] += kSizes * column.typical * weights.weight[k];
      }
    }
    const Eigen::VectorXd q = recording.q.row(k);
    const Eigen::Vector3d moved = chain.Pose<double>(q, delta, ends).translation() -
                                  chain.Pose<double>(q, zero, ends).translation();
    recording.p_WQ.row(k) += moved.transpose();
  }
  const DiagnosisResult d = Diagnosed(draw.spec, recording);
  EXPECT_TRUE(d.verdict == DiagnosisVerdict::kExplained ||
              d.verdict == DiagnosisVerdict::kAmbiguous)
      << ToString(d.verdict) << ": " << d.summary;
  bool listed = false;
  for (const Finding& f : d.findings) {
    const auto is_it = [&](const EffectRequest& e) {
      return e.effect == name && e.joint == request.joint && e.words == request.words;
    };
    const bool own = is_it(f.effect);
    listed = listed || own;
    for (const Confusable& other : f.confusable_with) listed = listed || is_it(other.effect);
    if (!own) continue;
    const double expected = kSizes * columns.front().typical;
    // Settings are found to a finite resolution, so a little more than the interval.
    EXPECT_NEAR(
        f.parameters[0].value, expected, 4 * f.parameters[0].sigma + 0.05 * std::abs(expected));
  }
  EXPECT_TRUE(listed) << d.summary;
}

std::vector<const Effect*> Physics() {
  std::vector<const Effect*> physics;
  for (const Effect* const effect : AllEffects()) {
    const std::string name = effect->Describe().name;
    // Geometry is tested above; a scale is never visible.
    if (name == "axis_tilt" || name == "base_frame" || name == "tool_offset") continue;
    // An error curve is offered beside several lines of a gear only: error_curve_test.cc.
    // Distances to an anchor: wire_with_length_offset in recorded_cases_test.cc.
    const std::set<std::string> elsewhere = {"sensor_scale", "transmission_error", "length_offset"};
    // Those of a measuring head: head_effects_test.cc.
    if (elsewhere.count(name) == 0 && !effect->Describe().of_head) physics.push_back(effect);
  }
  return physics;
}

INSTANTIATE_TEST_SUITE_P(Library, OwnData, testing::ValuesIn(Physics()), [](const auto& param) {
  return param.param->Describe().name;
});

}  // namespace
}  // namespace dhcal
