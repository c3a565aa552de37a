#include "tools/plan/run.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "problems/simulate.h"
#include "tests/support/comma_locale.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class PlanRun : public testing::Test {
 protected:
  PlanRun() {
    command_.problem = DHCAL_SOURCE_DIR "/problems/cases/kr15_planned.yaml";
    command_.out = folder_ / "poses.csv";
    command_.poses = "25";
    command_.candidates = "120";
  }
  int Run() {
    out_.str("");
    messages_.str("");
    return RunPlan(command_, out_, messages_);
  }

  TempFolder folder_;
  PlanCommand command_;
  std::ostringstream out_, messages_;
};

TEST_F(PlanRun, WritesPosesThatASimulationReads) {
  ASSERT_EQ(Run(), kPlanOk) << messages_.str();
  EXPECT_THAT(out_.str(),
              AllOf(HasSubstr("300 random poses in the box"),
                    HasSubstr("Your recording (100 poses)"),
                    HasSubstr("written")));
  Diagnostics diagnostics;
  auto spec = ReadProblemFile(command_.problem, "", &diagnostics);
  ASSERT_TRUE(spec.has_value());
  spec->simulate->motion.kind = MotionKind::kFile;
  spec->simulate->motion.file = command_.out;
  const auto recording = SimulateRecording(*spec, &diagnostics);
  ASSERT_TRUE(recording.has_value()) << diagnostics.ToString();
  EXPECT_EQ(recording->num_rows(), 25);
}

TEST_F(PlanRun, TheSameSeedGivesTheSamePlanInAnyLocale) {
  ASSERT_EQ(Run(), kPlanOk);
  const std::string poses = ReadFile(command_.out), words = out_.str();
  {
    const CommaLocale comma;
    ASSERT_EQ(Run(), kPlanOk);
  }
  EXPECT_EQ(ReadFile(command_.out), poses);
  EXPECT_EQ(out_.str(), words);
  command_.seed = "2";
  ASSERT_EQ(Run(), kPlanOk);
  EXPECT_NE(ReadFile(command_.out), poses);
}

TEST_F(PlanRun, PlacementsAreRunsOfTheirEdges) {
  command_.problem = DHCAL_SOURCE_DIR "/problems/cases/kr15_edges.yaml";
  command_.poses = "4";
  command_.candidates = "15";
  command_.edge_poses = "9";
  ASSERT_EQ(Run(), kPlanOk) << messages_.str();
  EXPECT_THAT(out_.str(), AllOf(HasSubstr("measurement.edges"), HasSubstr("rpy_deg")));
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(command_.problem, "", &diagnostics);
  const auto rows = ReadRecording(command_.out, spec->robot.joints, &diagnostics);
  ASSERT_TRUE(rows.has_value()) << diagnostics.ToString();
  EXPECT_EQ(rows->num_rows(), 4 * 9);
  EXPECT_EQ(rows->edge_names.size(), 4U);
}

TEST_F(PlanRun, RefusesWhatItDoesNotUnderstandAndWritesNothing) {
  const auto expect_refused = [&](const std::string& words) {
    EXPECT_EQ(Run(), kPlanBadInput) << words;
    EXPECT_THAT(messages_.str(), HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(command_.out)) << words;
  };
  const PlanCommand good = command_;
  command_.poses = "many";
  expect_refused("--poses is 'many', but a number from 1 to 100000 is expected");
  command_ = good;
  command_.poses = "2.5";
  expect_refused("a whole number");
  command_ = good;
  command_.criterion = "E";
  expect_refused("--criterion is 'E', but D or I is expected");
  command_ = good;
  command_.volume = "0,0,0,1,1";
  expect_refused("two opposite corners");
  command_ = good;
  command_.volume = "5,5,5,6,6,6";
  expect_refused("only 0 poses in the volume");
  command_ = good;
  command_.candidates = "20";
  expect_refused("fewer than the 25");
  command_ = good;
  command_.problem = folder_ / "gone.yaml";
  expect_refused("gone.yaml");
  command_ = good;
  command_.problem.clear();
  expect_refused("--problem is missing");
}

TEST_F(PlanRun, SplitsTheAlternativesOfAResult) {
  command_.problem = DHCAL_SOURCE_DIR "/problems/cases/kr15_left_out.yaml";
  command_.poses = "4";
  command_.candidates = "30";
  command_.result = folder_ / "result.json";
  EXPECT_EQ(Run(), kPlanBadInput);
  EXPECT_THAT(messages_.str(), HasSubstr("result.json: error: cannot be opened"));
  WriteFile(command_.result, "{}");
  EXPECT_EQ(Run(), kPlanBadInput);
  EXPECT_THAT(messages_.str(), HasSubstr("has no diagnosis"));
  EXPECT_FALSE(std::filesystem::exists(command_.out));
  WriteFile(command_.result,
            R"({"diagnosis": {"hypotheses": [
              {"kept": true, "effects": [{"effect": "joint_compliance", "joint": 2}]},
              {"kept": true, "effects": [{"effect": "gear_harmonic", "joint": 2, "order": 1}]}]}})");
  ASSERT_EQ(Run(), kPlanOk) << messages_.str();
  EXPECT_THAT(out_.str(),
              AllOf(HasSubstr("gear_harmonic at joint 2 (order 1)"), HasSubstr("4 poses of")));
  const std::string csv = ReadFile(command_.out);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
}

TEST_F(PlanRun, PlansBeforeThereIsARecording) {
  WriteFile(folder_ / "p.yaml",
            "schema: 1\nrobot: {joints: [{a_m: 0.3, alpha_deg: 90}, {a_m: 0.2}, {a_m: 0.2}]}\n"
            "measurement: {kind: position, sigma_mm: 0.05}\nrecording: later.csv\n");
  command_.problem = folder_ / "p.yaml";
  ASSERT_EQ(Run(), kPlanOk) << messages_.str();
  EXPECT_THAT(messages_.str(), HasSubstr("is not there yet"));
}

}  // namespace
}  // namespace dhcal
