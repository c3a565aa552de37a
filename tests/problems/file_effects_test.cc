// Effects as a user writes them: put into a simulation, estimated, and held at their values.

#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/result/result_writer.h"
#include "problems/identify.h"
#include "problems/simulate.h"
#include "tests/support/problem_cases.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

constexpr char kRobot[] =
    "schema: 1\n"
    "robot:\n"
    "  joints:\n"
    "    - {d_m: 0.5, a_m: 0.1, alpha_deg: 90}\n"
    "    - {a_m: 0.6}\n"
    "    - {a_m: 0.1, alpha_deg: 90}\n"
    "    - {d_m: 0.5, alpha_deg: -90}\n"
    "    - {alpha_deg: 90}\n"
    "    - {d_m: 0.1}\n"
    "  base: {xyz_m: [2, 0.5, -0.3]}\n"
    "  tool: {xyz_m: [0.05, 0, 0.2]}\n"
    "measurement: {kind: position, sigma_mm: 0.03}\n";

/// 120 poses in four hours beside a motor's temperature.
std::string Rows() {
  Rng rng(81);
  std::string text = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,t_s,motor_temp\n";
  for (int row = 0; row < 120; ++row) {
    for (int joint = 0; joint < 6; ++joint) text += fmt::format("{:.6f},", rng.Uniform(-90, 90));
    text += fmt::format("{},{:.3f}\n", 120 * row, 40 + rng.Uniform(-10, 10));
  }
  return text;
}

/// What a fit finds of an effect that a simulation without noise was given, with the same settings.
FitResult FitOf(const std::string& effect, const std::string& put_in, const std::string& held) {
  const TempFolder folder;
  WriteFile(folder / "poses.csv", Rows());
  WriteFile(folder / "problem.yaml",
            kRobot + fmt::format("simulate:\n"
                                 "  motion: {{kind: file, file: poses.csv}}\n"
                                 "  effects: [{{{}, values: {{{}}}}}]\n"
                                 "parameters:\n"
                                 "  effects: [{{{}{}}}]\n",
                                 effect,
                                 put_in,
                                 effect,
                                 held));
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(folder / "problem.yaml", "", &diagnostics);
  EXPECT_TRUE(spec.has_value()) << diagnostics.ToString();
  const auto recording = SimulateRecording(*spec, &diagnostics);
  EXPECT_TRUE(recording.has_value()) << diagnostics.ToString();
  const Result result = IdentifyGeometry(*spec, *recording, {});
  EXPECT_NE(result.best(), nullptr);
  return *result.best();
}

struct Written {
  std::string effect, parameter;
  double value = 0;
};

class FileEffects : public testing::TestWithParam<Written> {};

TEST_P(FileEffects, AreEstimatedAsPutIn) {
  const Written& w = GetParam();
  const FitResult fit = FitOf(w.effect, fmt::format("{}: {}", w.parameter, w.value), "");
  const std::string name = w.effect.substr(8, w.effect.find(',') - 8) + "." + w.parameter;
  const std::map<std::string, ParameterResult> found = ByName(fit);
  ASSERT_EQ(found.count(name), 1) << name;
  // The weights are those of the nominal robot: right in the first order.
  EXPECT_NEAR(found.at(name).value, w.value, 1e-3 * std::abs(w.value));
  EXPECT_LT(fit.rms, 1e-7);
}

TEST_P(FileEffects, AreHeldAtTheirValues) {
  const Written& w = GetParam();
  const std::string values = fmt::format("{}: {}", w.parameter, w.value);
  EXPECT_LT(FitOf(w.effect, values, fmt::format(", values: {{{}}}", values)).rms, 1e-7);
  const std::string wrong = fmt::format("{}: {}", w.parameter, -w.value);
  EXPECT_GT(FitOf(w.effect, values, fmt::format(", values: {{{}}}", wrong)).rms, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    Written,
    FileEffects,
    testing::Values(
        Written{"effect: instrument_drift, time_constant_s: 3000", "scale", 2e-4},
        Written{"effect: column_driver, column: motor_temp, slot: theta3", "theta3", 2e-5},
        Written{"effect: column_driver, column: motor_temp, slot: alpha2", "alpha2", 2e-5},
        Written{"effect: column_driver, column: motor_temp, slot: base_ry", "base_ry", 2e-5}),
    [](const auto& param) { return param.param.parameter; });

TEST(FileEffectsWritten, WordsStandInTheCalibratedFileAsTheyAre) {
  const TempFolder folder;
  EffectRequest found;
  found.effect = "column_driver";
  found.words = {{"column", "Motor 2: T [degC]"}, {"slot", "theta2"}};
  found.values = {{"theta2", 1.5e-5}};
  found.held = true;
  const auto read = [&](const std::string& name, const std::string& text) {
    WriteFile(folder / name, text);
    Diagnostics diagnostics;
    const auto spec = ReadProblemFile(folder / name, "", &diagnostics);
    EXPECT_TRUE(spec.has_value()) << diagnostics.ToString();
    return *spec;
  };
  const ProblemSpec spec = read("problem.yaml", std::string(kRobot) + "recording: rows.csv\n");
  const ProblemSpec again =
      read("calibrated.yaml", CalibratedYaml(spec, spec.robot, {found}, "rows.csv"));
  ASSERT_EQ(again.parameters.effects.size(), 1);
  EXPECT_TRUE(again.parameters.effects[0].held);
  EXPECT_TRUE(again.parameters.effects[0].SameAs(found));
  EXPECT_EQ(again.parameters.effects[0].values, found.values);
}

}  // namespace
}  // namespace dhcal
