#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/math/rotation.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/result/result_writer.h"
#include "tests/support/comma_locale.h"
#include "tests/support/temp_folder.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr char kProblem[] = R"(# by hand
schema: 1
name: "cell 7"
robot:
  name: two-joint test arm
  convention: modified
  units: {angle: rad, length: mm}
  joints:
    - {name: turn, type: revolute, theta: 0.5, d: 100, a_m: 0.3, alpha: 1.5707963267948966, sign: -1}
    - {name: slide, type: prismatic, theta_deg: 90, a: 0, alpha_deg: 0}
  base: {xyz_mm: [10, 20, 30], rpy_deg: [0, 0, 45], per_run: true, runs: {day: {xyz_m: [1, 2, 3]}}}
  tool: {xyz_m: [0, 0, 0.2]}
  gravity_m_s2: [0, 0, -9.81]
  payload: {mass_kg: 2, com_mm: [0, 0, 50]}
measurement: {kind: position, sigma_mm: 0.02}
recording: data/day.csv
parameters:
  estimate: [theta, d]
  fix: [theta2]
  prior_sigma: {d_mm: 0.5}
solver: {method: both, kappa: 1e-9}
)";

constexpr char kTargets[] = R"(schema: 1
name: targets
robot:
  joints:
    - {type: revolute, theta_deg: 0, d_m: 0.1, a_m: 0.3, alpha_deg: 90}
  targets: {A: {xyz_m: [0, 0, 0.2]}, "B 2": {xyz_mm: [1, 2, 3], rpy_deg: [10, 20, 30]}}
measurement: {kind: position}
parameters: {estimate: [theta]}
simulate:
  motion: {kind: random, poses: 30, min_deg: [-90], max_deg: [90]}
  noise_mm: 0.1
)";

constexpr char kEffects[] = R"(schema: 1
name: effects
robot:
  joints:
    - {d_m: 0.5, a_m: 0.3, alpha_deg: 90}
    - {a_m: 0.4}
    - {a_m: 0.2}
measurement: {kind: position}
recording: day.csv
parameters:
  estimate: [theta1]
  effects:
    - {effect: joint_coupling, joint: 3, driver_joint: 1}
    - {effect: joint_coupling, joint: 3}
    - {effect: joint_gain, joint: 1, values: {gain: 5e-4}}
    - {effect: gear_harmonic, joint: 2, order: 2}
)";

constexpr char kLinks[] = R"(schema: 1
name: masses
robot:
  joints:
    - {d_m: 0.5, a_m: 0.3, alpha_deg: 90}
    - {a_m: 0.4}
  links:
    - {mass_kg: 60, com_m: [-0.2, 0.1, 0]}
    - {mass_kg: 40.0, com_mm: [-300, 0, 50]}
measurement: {kind: position}
recording: day.csv
)";

Recording EffectRows() {
  Recording recording;
  recording.q = (Eigen::Matrix3d() << 0.1, 0.2, 0.3, -0.4, 0.5, 0.6, 0.7, -0.8, 0.9).finished();
  return recording;
}

/// What a fit of kEffects reports; the effect that it held is no parameter.
std::vector<ParameterResult> EffectsFound() {
  std::vector<ParameterResult> found;
  const auto add = [&](const std::string& name, Unit unit, double value) {
    ParameterResult result;
    result.name = name;
    result.unit = unit;
    result.value = value;
    result.verdict = Verdict::kIdentified;
    found.push_back(result);
  };
  add("theta1", Unit::kRadian, 0.1);
  add("joint_coupling.3.coupling", Unit::kOther, 1.2345678901234567e-4);
  add("joint_coupling.3.coupling", Unit::kOther, -2e-4);
  add("gear_harmonic.2.sin_2", Unit::kOther, 3e-5);
  add("gear_harmonic.2.cos_2", Unit::kOther, -4e-5);
  return found;
}

ProblemSpec ReadFrom(const TempFolder& folder, const std::string& name, const std::string& text) {
  WriteFile(folder / name, text);
  Diagnostics diagnostics;
  std::optional<ProblemSpec> spec = ReadProblemFile(folder / name, "", &diagnostics);
  EXPECT_TRUE(spec.has_value()) << diagnostics.ToString() << text;
  return spec.value_or(ProblemSpec());
}

/// Moves every number of the robot by something with all its digits.
RobotModel Perturbed(RobotModel robot, Rng* rng) {
  const auto move = [rng](Eigen::Isometry3d* X) {
    for (double& value : X->translation()) value += 1e-3 * rng->Normal();
    const Eigen::Vector3d r(rng->Normal(), rng->Normal(), rng->Normal());
    X->linear() = ExpSO3<double>(1e-2 * r) * X->linear();
  };
  for (JointRow& row : robot.joints) {
    for (double* value : {&row.theta, &row.d, &row.a, &row.alpha, &row.beta}) {
      *value += 1e-3 * rng->Normal();
    }
  }
  move(&robot.X_WB);
  for (RunFrame& frame : robot.base_of_run) move(&frame.X);
  if (robot.targets.empty()) move(&robot.X_TQ);
  for (Target& target : robot.targets) move(&target.X_TQ);
  return robot;
}

void ExpectSamePose(const Eigen::Isometry3d& a,
                    const Eigen::Isometry3d& b,
                    double tolerance = 2e-15) {
  EXPECT_EQ(a.translation(), b.translation());
  EXPECT_LT((a.linear() - b.linear()).cwiseAbs().maxCoeff(), tolerance);
}

void ExpectSameRobot(const RobotModel& a, const RobotModel& b) {
  ASSERT_EQ(a.num_joints(), b.num_joints());
  for (int i = 0; i < a.num_joints(); ++i) {
    EXPECT_EQ(a.joints[i].name, b.joints[i].name);
    EXPECT_EQ(a.joints[i].type, b.joints[i].type);
    EXPECT_EQ(a.joints[i].sign, b.joints[i].sign);
    EXPECT_EQ(a.joints[i].d, b.joints[i].d);
    EXPECT_EQ(a.joints[i].a, b.joints[i].a);
    EXPECT_NEAR(a.joints[i].theta, b.joints[i].theta, 1e-15);
    EXPECT_NEAR(a.joints[i].alpha, b.joints[i].alpha, 1e-15);
    EXPECT_NEAR(a.joints[i].beta, b.joints[i].beta, 1e-15);
  }
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.convention, b.convention);
  EXPECT_EQ(a.gravity_B, b.gravity_B);
  EXPECT_EQ(a.payload.mass, b.payload.mass);
  EXPECT_EQ(a.payload.p_LC, b.payload.p_LC);
  ExpectSamePose(a.X_WB, b.X_WB);
  ExpectSamePose(a.X_TQ, b.X_TQ);
}

TEST(CalibratedYaml, ReadsBackAsTheCalibratedRobot) {
  const TempFolder folder;
  Rng rng(7);
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kProblem);
  for (int i = 0; i < 50; ++i) {
    const RobotModel robot = Perturbed(spec.robot, &rng);
    const std::string text = CalibratedYaml(spec, robot, {}, "../data/day.csv");
    const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", text);
    ExpectSameRobot(robot, read.robot);
    EXPECT_TRUE(read.robot.base_per_run);
    ASSERT_EQ(read.robot.base_of_run.size(), 1u);
    EXPECT_EQ(read.robot.base_of_run[0].run, "day");
    ExpectSamePose(read.robot.base_of_run[0].X, robot.base_of_run[0].X);
  }
}

TEST(CalibratedYaml, KeepsEverythingElse) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kProblem);
  const std::string text = CalibratedYaml(spec, spec.robot, {}, "recording.csv");
  const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", text);
  EXPECT_EQ(read.name, "cell 7");
  EXPECT_EQ(read.measurement.sigma, spec.measurement.sigma);
  EXPECT_EQ(read.parameters.estimate, spec.parameters.estimate);
  EXPECT_EQ(read.parameters.fix, spec.parameters.fix);
  EXPECT_EQ(read.parameters.prior_sigma, spec.parameters.prior_sigma);
  EXPECT_EQ(read.solver.kappa, spec.solver.kappa);
  EXPECT_EQ(read.solver.method, SolverMethod::kBoth);
  EXPECT_EQ(read.recording, folder / "recording.csv");
}

TEST(CalibratedYaml, WritesUnitsAtEachNumberAndNoneElsewhere) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kProblem);
  const std::string text = CalibratedYaml(spec, spec.robot, {}, "recording.csv");
  EXPECT_THAT(text, StartsWith("# Made by ceres_dhcal from problem.yaml:"));
  EXPECT_THAT(text,
              HasSubstr("{name: turn, type: revolute, sign: -1, theta_deg: 28.64788975654116, "
                        "d_m: 0.1, a_m: 0.3, alpha_deg: 90}"));
  EXPECT_THAT(text, AllOf(Not(HasSubstr("units")), Not(HasSubstr("beta"))));
}

TEST(CalibratedYaml, ReplacesTargetsAndTheSimulation) {
  const TempFolder folder;
  Rng rng(8);
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kTargets);
  const RobotModel robot = Perturbed(spec.robot, &rng);
  const std::string text = CalibratedYaml(spec, robot, {}, "recording.csv");
  const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", text);
  EXPECT_FALSE(read.simulate.has_value());
  EXPECT_EQ(read.recording, folder / "recording.csv");
  ASSERT_EQ(read.robot.targets.size(), 2u);
  EXPECT_EQ(read.robot.targets[1].name, "B 2");
  ExpectSamePose(read.robot.targets[0].X_TQ, robot.targets[0].X_TQ);
  ExpectSamePose(read.robot.targets[1].X_TQ, robot.targets[1].X_TQ);
  ExpectSamePose(read.robot.X_WB, robot.X_WB);  // the file had no base
}

TEST(CalibratedYaml, KeepsRotationsAtAndNearGimbalLock) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kProblem);
  for (const double off : {0.0, 1e-13, 1e-10, 1e-7, 1e-4}) {
    RobotModel robot = spec.robot;
    robot.X_WB.linear() = RotationFromRpy({0.3, kPi / 2, -0.4}) * ExpSO3<double>({off, -off, off});
    const std::string text = CalibratedYaml(spec, robot, {}, "recording.csv");
    ExpectSamePose(ReadFrom(folder, "calibrated.yaml", text).robot.X_WB, robot.X_WB, 1e-12);
  }
}

TEST(CalibratedYaml, DoesNotSpreadAChangeThroughYamlAliases) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", R"(schema: 1
name: aliases
robot:
  joints:
    - {theta_deg: 0, d_m: 0.1, a_m: 0.3, alpha_deg: 90}
  base: &frame {xyz_m: [0, 0, 0.1]}
  tool: *frame
measurement: {kind: position}
recording: day.csv
)");
  RobotModel robot = spec.robot;
  robot.X_TQ.translation().z() = 0.25;
  const std::string text = CalibratedYaml(spec, robot, {}, "day.csv");
  const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", text);
  ExpectSamePose(read.robot.X_WB, robot.X_WB);
  ExpectSamePose(read.robot.X_TQ, robot.X_TQ);
}

TEST(CalibratedYaml, HoldsEstimatedEffectsAtTheValuesFound) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kEffects);
  ASSERT_EQ(spec.parameters.effects.size(), 4u);
  const std::vector<EffectRequest> effects = EffectsAsFound(spec, EffectRows(), EffectsFound());
  const std::string text = CalibratedYaml(spec, spec.robot, effects, "day.csv");
  EXPECT_THAT(text, HasSubstr("its effects are held at what was found"));
  EXPECT_THAT(text,
              HasSubstr("{effect: joint_coupling, joint: 3, driver_joint: 1, values: {coupling: "));
  const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", text);
  ASSERT_EQ(read.parameters.effects.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    const EffectRequest& effect = read.parameters.effects[k];
    EXPECT_TRUE(effect.held);
    EXPECT_TRUE(effect.SameAs(spec.parameters.effects[k]));
    EXPECT_EQ(effect.values, effects[k].values);
  }
  // Two couplings of one joint have one name; each gets its own value.
  EXPECT_EQ(read.parameters.effects[0].values.at("coupling"), 1.2345678901234567e-4);
  EXPECT_EQ(read.parameters.effects[1].values.at("coupling"), -2e-4);
  EXPECT_EQ(read.parameters.effects[2].values.at("gain"), 5e-4);  // as the file gave it
  EXPECT_EQ(read.parameters.effects[3].values.at("sin_2"), 3e-5);
  EXPECT_EQ(read.parameters.effects[3].values.at("cos_2"), -4e-5);
}

TEST(CalibratedYaml, LeavesEffectsToBeEstimatedWhereNothingElseIs) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kEffects);
  std::vector<ParameterResult> found = EffectsFound();
  found.front().verdict = Verdict::kFixed;  // theta1
  const std::vector<EffectRequest> effects = EffectsAsFound(spec, EffectRows(), found);
  const std::string text = CalibratedYaml(spec, spec.robot, effects, "day.csv");
  const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", text);
  ASSERT_EQ(read.parameters.effects.size(), 4u);
  EXPECT_FALSE(read.parameters.effects[0].held);
  EXPECT_TRUE(read.parameters.effects[2].held);
}

TEST(CalibratedYaml, AppendsEffectsThatTheFileDoesNotHave) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kEffects);
  std::vector<EffectRequest> effects = EffectsAsFound(spec, EffectRows(), EffectsFound());
  effects.push_back(Request("joint_compliance", 2, {{"compliance", 3.0123456789012e-6}}));
  effects.push_back(Request(
      "gear_harmonic", 1, {{"sin_17.25", 1e-4}, {"cos_17.25", -2.5e-5}}, {{"order", 17.25}}));
  effects.push_back(Request("tool_step", 0, {{"x", 1e-4}}, {{"at_row", 3}}));
  for (EffectRequest& effect : effects) effect.held = true;
  const std::string text = CalibratedYaml(spec, spec.robot, effects, "day.csv");
  EXPECT_THAT(text, HasSubstr("{effect: tool_step, at_row: 3, values: {x: "));
  const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", text);
  EXPECT_EQ(read.parameters.estimate, spec.parameters.estimate);
  ASSERT_EQ(read.parameters.effects.size(), effects.size());
  for (std::size_t k = 0; k < effects.size(); ++k) {
    EXPECT_TRUE(read.parameters.effects[k].held) << k;
    EXPECT_TRUE(read.parameters.effects[k].SameAs(effects[k])) << k;
    EXPECT_EQ(read.parameters.effects[k].values, effects[k].values) << k;
  }
}

TEST(CalibratedYaml, AppendsEffectsToAFileWithoutAny) {
  const TempFolder folder;
  EffectRequest found = Request("joint_compliance", 2, {{"compliance", 3e-6}});
  found.held = true;
  for (const char* const parameters : {"", "parameters: {estimate: [theta]}\n"}) {
    const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kLinks + std::string(parameters));
    const std::string text = CalibratedYaml(spec, spec.robot, {found}, "day.csv");
    const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", text);
    EXPECT_EQ(read.parameters.estimate, spec.parameters.estimate);
    ASSERT_EQ(read.parameters.effects.size(), 1u) << text;
    EXPECT_TRUE(read.parameters.effects[0].held && read.parameters.effects[0].SameAs(found));
    EXPECT_EQ(read.parameters.effects[0].values, found.values);
  }
}

TEST(CalibratedYaml, WritesMassesOnlyWhereTheyHaveChanged) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kLinks);
  const std::string unchanged = CalibratedYaml(spec, spec.robot, {}, "day.csv");
  EXPECT_THAT(unchanged, AllOf(HasSubstr("mass_kg: 40.0"), HasSubstr("com_mm: [-300, 0, 50]")));
  RobotModel robot = spec.robot;
  robot.links[1] = {37.123456789012345, {-0.31, 1.0 / 3, 0.05}};
  const std::string changed = CalibratedYaml(spec, robot, {}, "day.csv");
  EXPECT_THAT(changed, Not(HasSubstr("com_mm")));
  const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", changed);
  ASSERT_EQ(read.robot.links.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.robot.links[i].mass, robot.links[i].mass);
    EXPECT_EQ(read.robot.links[i].p_LC, robot.links[i].p_LC);
  }
}

TEST(CalibratedYaml, WritesMassesThatTheFileDoesNotHave) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kTargets);
  EXPECT_THAT(CalibratedYaml(spec, spec.robot, {}, "day.csv"), Not(HasSubstr("links")));
  RobotModel robot = spec.robot;
  robot.links = {{50, {-0.2, 0.1, 0}}};
  const std::string text = CalibratedYaml(spec, robot, {}, "day.csv");
  const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", text);
  ASSERT_EQ(read.robot.links.size(), 1u);
  EXPECT_EQ(read.robot.links[0].mass, 50);
}

TEST(CalibratedYaml, GivesEachRunItsFrameWhereTheFileHasOneForAll) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kLinks);
  RobotModel robot = spec.robot;
  robot.base_per_run = true;
  robot.base_of_run = {{"day", robot.X_WB}, {"night", robot.X_WB}};
  robot.base_of_run[1].X.translation().x() += 1e-4;
  const std::string text = CalibratedYaml(spec, robot, {}, "day.csv");
  const ProblemSpec read = ReadFrom(folder, "calibrated.yaml", text);
  EXPECT_TRUE(read.robot.base_per_run);
  ASSERT_EQ(read.robot.base_of_run.size(), 2u) << text;
  EXPECT_EQ(read.robot.base_of_run[1].run, "night");
  ExpectSamePose(read.robot.base_of_run[1].X, robot.base_of_run[1].X);
}

TEST(CalibratedYaml, RefusesAFileThatHasChanged) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kProblem);
  WriteFile(folder / "problem.yaml", kTargets);
  EXPECT_THROW(CalibratedYaml(spec, spec.robot, {}, "x.csv"), std::runtime_error);
  std::filesystem::remove(folder / "problem.yaml");
  EXPECT_THROW(CalibratedYaml(spec, spec.robot, {}, "x.csv"), std::runtime_error);
}

TEST(CalibratedYaml, IsTheSameUnderACommaDecimalLocale) {
  const TempFolder folder;
  const ProblemSpec spec = ReadFrom(folder, "problem.yaml", kProblem);
  const std::string expected = CalibratedYaml(spec, spec.robot, {}, "x.csv");
  const CommaLocale locale;
  EXPECT_EQ(CalibratedYaml(spec, spec.robot, {}, "x.csv"), expected);
}

}  // namespace
}  // namespace dhcal
