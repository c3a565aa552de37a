// A column that the program does not know is named as the driver of a slot where it is one, and
// only there; on recordings of the simulator, which shares no code with the library.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/problem_cases.h"
#include "tests/support/sanitized.h"
#include "tests/tools/proof/simulator/read_back.h"
#include "tools/proof/simulator/arms.h"
#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/random/poses.h"
#include "tools/proof/simulator/random/random_files.h"

namespace dhcal {
namespace {

using concealed::RandomTrial;
using concealed::RecordedColumn;

/// 200 poses of a KR 15 in random order, one every 40 s.
RandomTrial MakeTrial(std::uint64_t seed) {
  RandomTrial trial;
  trial.seed = seed;
  trial.settings.decimals = 6;
  trial.settings.clock = true;
  Rng rng(seed);
  trial.drawing = concealed::KukaKr15();
  trial.stated = trial.drawing;
  trial.built = concealed::AsBuilt(trial.drawing, &rng);
  trial.motion = concealed::DrawMotion(trial.settings, trial.drawing, &rng);
  return trial;
}

/// A course of slow waves and steps of chance, in degC of a motor.
RecordedColumn Column(const std::string& name, Eigen::Index rows, std::uint64_t seed) {
  Rng rng(seed);
  RecordedColumn column;
  column.name = name;
  column.course.resize(rows);
  double level = 0;
  for (Eigen::Index row = 0; row < rows; ++row) {
    level = 0.8 * level + rng.Normal();
    column.course[row] = level + std::sin(0.05 * static_cast<double>(row));
  }
  column.course.array() -= column.course.mean();
  column.course /= std::sqrt(column.course.squaredNorm() / static_cast<double>(rows));
  column.read = 40 + 5 * column.course.array();
  return column;
}

DiagnosisResult DiagnosisOf(const RandomTrial& trial) {
  const ReadCase read = ReadBack(concealed::FilesOf(trial));
  EXPECT_TRUE(read.spec && read.recording) << read.diagnostics.ToString();
  return Diagnosed(*read.spec, *read.recording);
}

std::vector<std::string> NamesOf(const DiagnosisResult& d) {
  std::vector<std::string> names;
  for (const Finding& finding : d.findings) names.push_back(finding.effect.effect);
  return names;
}

TEST(ColumnDriverFound, AtItsSlotWithItsRateBesideAColumnThatDrivesNothing) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  const std::vector<std::pair<std::string, std::string>> places = {
      {"theta3", "joint 3"}, {"a2", "link 2"}, {"base_y", "base"}};
  for (const auto& place : places) {
    RandomTrial trial = MakeTrial(51);
    trial.columns = {Column("cabinet", 200, 52), Column("motor_temp", 200, 53)};
    trial.causes = {concealed::Follows("motor_temp", place.first, trial.columns[1].course, 2e-4)};
    const DiagnosisResult d = DiagnosisOf(trial);
    ASSERT_THAT(NamesOf(d), testing::ElementsAre("column_driver")) << d.summary;
    const Finding& finding = d.findings[0];
    EXPECT_EQ(finding.effect.word("column"), "motor_temp");
    EXPECT_EQ(finding.effect.word("slot"), place.first);
    EXPECT_EQ(finding.location, place.second);
    EXPECT_EQ(finding.driver, "column motor_temp");
    EXPECT_THAT(finding.sentence, testing::HasSubstr("follows the column 'motor_temp'"));
    ASSERT_EQ(finding.parameters.size(), 1);
    EXPECT_EQ(finding.parameters[0].name, "column_driver." + place.first);
    // The file has the course times 5, rounded to 0.001.
    EXPECT_NEAR(finding.parameters[0].value, 2e-4 / 5, 4 * finding.parameters[0].sigma);
    EXPECT_LT(finding.rms_test_after, 0.8 * finding.rms_test_before);
    EXPECT_TRUE(finding.confusable_with.empty()) << d.summary;
  }
}

TEST(ColumnDriverFound, NotWhereColumnsDriveNothing) {
  for (std::uint64_t seed = 61; seed < (kSanitized ? 62 : 67); ++seed) {
    RandomTrial trial = MakeTrial(seed);
    for (int k = 0; k < 4; ++k) {
      trial.columns.push_back(
          Column("column_" + std::to_string(k), 200, 100 * seed + static_cast<std::uint64_t>(k)));
    }
    const DiagnosisResult d = DiagnosisOf(trial);
    EXPECT_EQ(d.verdict, DiagnosisVerdict::kConsistent) << seed << ": " << d.summary;
  }
}

TEST(ColumnDriverFound, AColumnThatRepeatsAJointIsACoupling) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  RandomTrial trial = MakeTrial(71);
  trial.causes = {concealed::Coupled(5, 4, 3e-4)};
  RecordedColumn axis = Column("axis4_motor", 200, 72);
  axis.read = -100 * trial.motion.q.col(3);
  trial.columns = {axis};
  const DiagnosisResult d = DiagnosisOf(trial);
  ASSERT_THAT(NamesOf(d), testing::ElementsAre("joint_coupling")) << d.summary;
  for (const Confusable& other : d.findings[0].confusable_with) {
    EXPECT_NE(other.effect.effect, "column_driver");
  }
}

TEST(ColumnDriverFound, AColumnThatRepeatsTheClockIsADrift) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  RandomTrial trial = MakeTrial(73);
  trial.causes = {concealed::JointDrifts(2, 4e-4, 3000)};
  RecordedColumn uptime = Column("uptime", 200, 74);
  uptime.read = 5e4 + trial.motion.time.array() / 60;
  trial.columns = {uptime};
  const DiagnosisResult d = DiagnosisOf(trial);
  EXPECT_THAT(NamesOf(d), testing::ElementsAre("joint_drift")) << d.summary;
}

TEST(ColumnDriverFound, AWarmingMotorThatIsRecordedIsListedWhereTheClockSaysTheSame) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  RandomTrial trial = MakeTrial(75);
  trial.causes = {concealed::JointDrifts(2, 4e-4, 2000)};
  RecordedColumn motor = Column("motor_temp", 200, 76);
  motor.read = 20 + 30 * (1 - (-trial.motion.time.array() / 2000).exp());
  trial.columns = {motor};
  const DiagnosisResult d = DiagnosisOf(trial);
  std::vector<std::string> names = NamesOf(d);
  for (const Finding& finding : d.findings) {
    for (const Confusable& other : finding.confusable_with) names.push_back(other.effect.effect);
  }
  EXPECT_THAT(names, testing::Contains("joint_drift")) << d.summary;
  EXPECT_THAT(names, testing::Contains("column_driver")) << d.summary;
}

}  // namespace
}  // namespace dhcal
