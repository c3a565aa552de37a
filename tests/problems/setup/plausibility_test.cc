#include "problems/setup/plausibility.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "problems/diagnosis/calibrate.h"
#include "problems/setup/frames_alone.h"
#include "residuals/registry.h"
#include "tests/support/files.h"
#include "tests/support/problem_cases.h"
#include "tests/support/sanitized.h"
#include "tests/support/set_up_files.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

Result Calibrated(const ProblemSpec& spec, const Recording& recording) {
  ProblemSpec quick = spec;
  quick.diagnosis.run = DiagnosisRun::kNever;
  return Calibrate(quick, recording, {});
}

TEST(Plausibility, PassesAnHonestRecording) {
  Rng rng(1);
  const ProblemSpec spec = ProblemOf(Kr15(), KindNamed("pose"));
  const Result result = Calibrated(spec, RecordingOfRobot(spec.robot, 60, 30e-6, &rng));
  EXPECT_TRUE(result.setup.plausible);
  EXPECT_TRUE(result.setup.causes.empty());
  EXPECT_NE(result.best(), nullptr);
}

TEST(Plausibility, RefusesRepeatsOfTwoPoses) {
  Rng rng(2);
  const ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
  Recording recording = RecordingOfRobot(spec.robot, 80, 30e-6, &rng);
  for (int row = 2; row < 80; ++row) {
    recording.q.row(row) = recording.q.row(row % 2);
    recording.p_WQ.row(row) = recording.p_WQ.row(row % 2);
  }
  const Result result = Calibrated(spec, recording);
  EXPECT_FALSE(result.setup.plausible);
  EXPECT_EQ(result.best(), nullptr);
  ASSERT_EQ(result.setup.reasons.size(), 1U);
  EXPECT_THAT(result.setup.reasons[0], HasSubstr("only 2 distinct poses"));
}

TEST(Plausibility, RefusesTheControllersOwnPositions) {
  Rng rng(3);
  const ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
  Recording recording = RecordingOfRobot(spec.robot, 40, 0, &rng);
  // As the nominal robot says it, to a hundredth of a millimetre.
  recording.p_WQ = 1e-5 * (FitFrames(spec, recording).points.transpose() / 1e-5).array().round();
  const Result result = Calibrated(spec, recording);
  EXPECT_FALSE(result.setup.plausible);
  ASSERT_EQ(result.setup.causes.size(), 1U);
  EXPECT_EQ(result.setup.causes[0].kind, "own_position");
}

/// A good robot whose angles are written to a hundredth of a degree: its errors and the noise are
/// smaller than what that rounding makes of them.
TEST(Plausibility, TakesCoarseJointAnglesForNoControllersPositions) {
  for (const std::uint64_t seed : {5U, 6U, 7U}) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
    Recording recording = RecordingOfRobot(spec.robot, 80, 15e-6, &rng, /*errors=*/0.1);
    recording.p_WQ = 1e-6 * (recording.p_WQ / 1e-6).array().round();
    recording.q = 0.01 * kDegree * (recording.q / (0.01 * kDegree)).array().round();
    const Result result = Calibrated(spec, recording);
    EXPECT_TRUE(result.setup.plausible) << testing::PrintToString(result.setup.reasons);
  }
}

TEST(Plausibility, RefusesTheControllersOwnPositionsBesideCoarseJointAngles) {
  for (const std::uint64_t seed : {5U, 6U, 7U}) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
    Recording recording = RecordingOfRobot(spec.robot, 80, 0, &rng);
    recording.p_WQ = 1e-5 * (FitFrames(spec, recording).points.transpose() / 1e-5).array().round();
    recording.q = 0.01 * kDegree * (recording.q / (0.01 * kDegree)).array().round();
    const Result result = Calibrated(spec, recording);
    EXPECT_FALSE(result.setup.plausible);
    ASSERT_EQ(result.setup.causes.size(), 1U);
    EXPECT_EQ(result.setup.causes[0].kind, "own_position");
    EXPECT_THAT(result.setup.causes[0].sentence, HasSubstr("last digit of the joints"));
  }
}

TEST(Plausibility, LeavesNothingThatCouldBeTakenForACalibration) {
  Rng rng(4);
  const ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
  Recording recording = RecordingOfRobot(spec.robot, 60, 30e-6, &rng);
  recording.p_WQ /= 1000;  // metres under the name of millimetres
  std::optional<CuredFiles> cured;
  const Result result = Calibrate(spec, recording, {}, &cured);
  EXPECT_FALSE(result.setup.plausible);
  EXPECT_EQ(result.best(), nullptr);
  EXPECT_FALSE(result.diagnosis.has_value());
  EXPECT_FALSE(result.delivered.has_value());
  EXPECT_TRUE(result.residuals.empty());
  for (const FitResult& fit : result.fits) EXPECT_TRUE(fit.parameters.empty());
  ASSERT_TRUE(cured.has_value());
  EXPECT_TRUE(Calibrated(cured->spec, cured->recording).setup.plausible);
}

TEST(Plausibility, NamesFramesThatAreHeldFarFromWhereTheyAre) {
  Rng rng(5);
  ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
  spec.parameters.estimate = {"theta", "alpha", "a", "d"};
  const Result result = Calibrated(spec, RecordingOfRobot(spec.robot, 60, 30e-6, &rng));
  EXPECT_EQ(result.best(), nullptr);
  ASSERT_EQ(result.setup.causes.size(), 1U);
  EXPECT_EQ(result.setup.causes[0].kind, "frame_not_estimated");
}

TEST(Plausibility, AccusesNoFramesOfAFitThatFailedByItsSolver) {
  const ProblemSpec spec = LoadCase("kr15_noisy_paper_rule");
  const Result result = Calibrated(spec, RecordingOf(spec));
  EXPECT_EQ(result.best(), nullptr) << "the paper's tolerance diverges on noise";
  EXPECT_TRUE(result.setup.plausible);
  EXPECT_TRUE(result.setup.causes.empty());
}

/// Set-ups of another author, each with a text that says what is right.
struct SharedSetUp {
  std::string name;
  std::string kind;
  std::string says;  // in the sentence or the line to write
};

void PrintTo(const SharedSetUp& shared, std::ostream* out) { *out << shared.name; }

class SharedSetUps : public testing::TestWithParam<SharedSetUp> {};

TEST_P(SharedSetUps, AreNamedAsTheirTextSays) {
  if (SharedDir().empty()) {
    GTEST_SKIP() << "set DHCAL_SHARED to the folder that holds cases/ to run this test";
  }
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  const ProblemSpec spec = LoadProblem(SharedDir() + "/cases/" + GetParam().name + "/problem.yaml");
  const Result result = Calibrate(spec, RecordingOf(spec), {});
  EXPECT_FALSE(result.setup.plausible);
  EXPECT_EQ(result.best(), nullptr);
  ASSERT_EQ(result.setup.causes.size(), 1U);
  const SetupCause& cause = result.setup.causes[0];
  EXPECT_EQ(cause.kind, GetParam().kind);
  EXPECT_THAT(cause.sentence + "\n" + cause.text, HasSubstr(GetParam().says));
  EXPECT_GT(cause.where.line, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Texts,
    SharedSetUps,
    testing::Values(
        SharedSetUp{"alpha_radians_as_degrees", "unit", "1.5708 is 90 deg"},
        SharedSetUp{"columns_reversed", "joint_order", "6, 5, 4, 3, 2, 1"},
        SharedSetUp{"controller_position", "own_position", "to their last digit (0.01 mm"},
        SharedSetUp{"coupling_j2_j3",
                    "coupling",
                    "effect: joint_coupling, joint: 3, driver_joint: 2, values: {coupling: 1}"},
        SharedSetUp{"inches_as_mm", "unit", "inches"},
        SharedSetUp{"quaternion_order", "quaternion", "hold x, y, z, w"},
        SharedSetUp{"radians_as_degrees", "unit", "hold radians, not degrees"},
        SharedSetUp{"readings_shifted", "row_shift", "From row 31 (line 32) on"},
        SharedSetUp{"sign_2", "joint_sense", "sign: -1"},
        SharedSetUp{"standard_as_modified", "convention", "convention: standard"},
        SharedSetUp{"zero_90_j3", "zero_offset", "theta_deg: 90"}),
    [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace dhcal
