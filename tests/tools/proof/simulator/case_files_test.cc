// The concealed cases as files: readable by the program, sealed, and with nothing of the answer.

#include "tools/proof/simulator/case_files.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/files.h"
#include "tests/support/sanitized.h"
#include "tests/tools/proof/simulator/read_back.h"
#include "tools/proof/simulator/scenarios.h"

namespace dhcal::concealed {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const Scenario& Named(const std::string& name) {
  for (const Scenario& scenario : AllScenarios()) {
    if (scenario.name == name) return scenario;
  }
  ADD_FAILURE() << "no scenario " << name;
  return AllScenarios().front();
}

TEST(Sha256, IsTheStandardsOwnExample) {
  EXPECT_EQ(Sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

class EveryScenario : public ::testing::TestWithParam<Scenario> {
 protected:
  static Trial Make(int seed) { return MakeTrial(GetParam(), seed); }
};

TEST_P(EveryScenario, GivesFilesThatTheProgramReadsAndAnAnswerThatItDoesNotSee) {
  if (GetParam().most_seeds == 1) GTEST_SKIP() << "100,000 rows; dhcal_prove runs it";
  const CaseFiles files = FilesOf(Make(2));
  const ReadCase read = ReadBack(files);
  ASSERT_TRUE(read.spec && read.recording) << read.diagnostics.ToString();
  EXPECT_GE(read.recording->num_rows(), 200);
  EXPECT_THAT(files.problem, HasSubstr(Sha256(files.answer)));
  EXPECT_THAT(files.problem, Not(HasSubstr("effect")));
  EXPECT_THAT(files.problem, Not(HasSubstr("beta")));
  const auto answer = nlohmann::json::parse(files.answer);
  EXPECT_EQ(answer.at("group") == "null", answer.at("causes").empty());
}

TEST_P(EveryScenario, IsTheSameForTheSameSeedAndAnotherForAnother) {
  if (GetParam().most_seeds == 1) GTEST_SKIP() << "100,000 rows; dhcal_prove runs it";
  if (kSanitized) GTEST_SKIP() << "the test before runs the same code";
  const CaseFiles once = FilesOf(Make(1)), again = FilesOf(Make(1)), other = FilesOf(Make(4));
  EXPECT_EQ(once.recording, again.recording);
  EXPECT_EQ(once.answer, again.answer);
  EXPECT_NE(once.recording, other.recording);
}

INSTANTIATE_TEST_SUITE_P(Suite,
                         EveryScenario,
                         ::testing::ValuesIn(AllScenarios()),
                         [](const auto& param) { return param.param.name; });

std::string ReadAll(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(KeptCases, NameTheHashOfTheirAnswers) {
  const fs::path kept = SourcePath("problems/cases/concealed");
  for (const char* const name : {"D5_kr15_01", "D10_ur10_02", "D18A_small_03"}) {
    const std::string answer = ReadAll(kept / "sealed" / (std::string(name) + ".json"));
    ASSERT_FALSE(answer.empty()) << name;
    EXPECT_THAT(ReadAll(kept / name / "problem.yaml"), HasSubstr(Sha256(answer))) << name;
    EXPECT_GT(ReadAll(kept / name / "recording.csv").size(), 10000U) << name;
  }
}

TEST(Scenarios, ShareNoNoise) {
  // The same seed in two scenarios must not repeat a rare draw.
  const Trial one = MakeTrial(Named("D1"), 1), two = MakeTrial(Named("D15"), 1);
  EXPECT_NE(one.noise_seed, two.noise_seed);
  EXPECT_NE(one.motion.q, two.motion.q);
}

TEST(Visibility, ConcealedEffectsAreBelowTheNoiseWhereTheyAreMeasuredAndLargeElsewhere) {
  for (const char* const name : {"D5", "D6"}) {
    if (kSanitized && name == std::string("D6")) continue;  // the same code, many times slower
    const Trial trial = MakeTrial(Named(name), 1);
    const Visibility& visibility = trial.causes[0].visibility;
    EXPECT_LT(visibility.visible_rms, trial.sensor.noise) << name;
    EXPECT_GT(visibility.raw_rms, 3 * trial.sensor.noise) << name;
    EXPECT_GT(TrueErrorElsewhere(trial).largest, 5 * visibility.visible_rms) << name;
  }
}

TEST(Visibility, AScaleOfTheInstrumentIsInvisible) {
  // The signature of a longer metre lies in what the geometry can do, to the last digit.
  const Trial trial = MakeTrial(Named("D1"), 1);
  const Eigen::MatrixXd geometry = GeometrySignatures(trial.built, trial.built, trial.motion);
  Sensor exact;
  exact.resolution = 1e-15;
  Rng rng(1);
  Trial noiseless = trial;
  noiseless.sensor = exact;
  const Eigen::MatrixXd readings = Readings(noiseless).transpose();
  const Eigen::VectorXd scale = Eigen::Map<const Eigen::VectorXd>(readings.data(), readings.size());
  EXPECT_LT(VisibilityOf(scale, geometry, 1, 1).visible_rms, 1e-6);
}

TEST(Visibility, PowerIsTheLevelWithoutAnEffectAndOneFarBeyondIt) {
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(30), much = Eigen::VectorXd::Ones(30);
  const Eigen::MatrixXd known = Eigen::MatrixXd::Identity(30, 2);
  EXPECT_LT(VisibilityOf(nothing, known, 1, 1).power, 1e-3);
  EXPECT_GT(VisibilityOf(much, known, 0.1, 1).power, 0.999);
  EXPECT_NEAR(VisibilityOf(much, known, 1, 1).lambda, 28, 1e-9);
}

}  // namespace
}  // namespace dhcal::concealed
