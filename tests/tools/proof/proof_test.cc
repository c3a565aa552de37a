// How a diagnosis is held against the sealed answer, and the quick suite as a user runs it.

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "tools/proof/score.h"
#include "tools/proof/suite.h"
#include "tools/proof/table.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json Answer() {
  return Json::parse(R"({"name": "D4_kr15_01", "scenario": "D4", "story": "", "group": "single",
    "robot": "kr15", "seed": 1, "noise_m": 3e-5, "causes": [{"effect": "joint_compliance",
    "joint": 2, "settings": {}, "values": {"compliance": 3e-6}, "class": "C1",
    "location": "joint 2", "slot": "theta2", "also": [], "power": 1.0}]})");
}

Json NullAnswer() {
  Json answer = Answer();
  answer["group"] = "null";
  answer["causes"] = Json::array();
  return answer;
}

Json FindingOf(const std::string& effect, int joint, const std::string& effect_class) {
  return {{"effect", effect},
          {"joint", joint},
          {"class", effect_class},
          {"location", "joint " + std::to_string(joint)},
          {"confusable_with", Json::array()},
          {"parameters", Json::array()}};
}

Json Diagnosis(const std::string& verdict, const std::vector<Json>& findings) {
  Json hypothesis = {{"effects", Json::array()}, {"kept", true}};
  for (const Json& finding : findings) hypothesis["effects"].push_back(finding);
  return {{"diagnosis",
           {{"verdict", verdict},
            {"misfit", {{"p_value", 0.001}}},
            {"findings", findings},
            {"hypotheses", {hypothesis}},
            {"hidden", Json::array()}}}};
}

TEST(ProofScore, CountsTheRightName) {
  const Json result = Diagnosis("explained", {FindingOf("joint_compliance", 2, "C1")});
  const ProofScore score = ScoreCase(Answer(), result, nullptr);
  EXPECT_TRUE(score.detected);
  EXPECT_TRUE(score.named);
  EXPECT_TRUE(score.place_right);
  EXPECT_TRUE(score.truth_kept);
  EXPECT_FALSE(score.wrong_single);
}

TEST(ProofScore, CountsAWrongNameGivenAlone) {
  const Json result = Diagnosis("explained", {FindingOf("joint_gain", 3, "C3")});
  const ProofScore score = ScoreCase(Answer(), result, nullptr);
  EXPECT_TRUE(score.wrong_single);
  EXPECT_FALSE(score.named);
  EXPECT_FALSE(score.place_right);
  EXPECT_FALSE(score.truth_kept);
}

TEST(ProofScore, ARightAndAWrongNameTogetherAreNotTheRightAnswer) {
  const Json result = Diagnosis(
      "explained", {FindingOf("joint_compliance", 2, "C1"), FindingOf("backlash", 4, "C4")});
  const ProofScore score = ScoreCase(Answer(), result, nullptr);
  EXPECT_FALSE(score.named);
  EXPECT_TRUE(score.wrong_single);
  EXPECT_FALSE(score.truth_kept);
}

TEST(ProofScore, AListedTruthCountsAndIsNoWrongName) {
  Json finding = FindingOf("base_compliance", 0, "C1");
  finding["location"] = "base";
  finding["confusable_with"].push_back(
      {{"effect", "joint_compliance"}, {"joint", 2}, {"location", "joint 2"}});
  const ProofScore score = ScoreCase(Answer(), Diagnosis("ambiguous", {finding}), nullptr);
  EXPECT_TRUE(score.named);
  EXPECT_TRUE(score.place_right);
  EXPECT_FALSE(score.wrong_single);
}

TEST(ProofScore, TheRightEffectAtAnotherOrderIsWrong) {
  Json answer = Answer();
  answer["causes"][0]["effect"] = "gear_harmonic";
  answer["causes"][0]["class"] = "";
  answer["causes"][0]["settings"]["order"] = 125.0;
  Json finding = FindingOf("gear_harmonic", 2, "C8");
  finding["order"] = 125.1;
  EXPECT_TRUE(ScoreCase(answer, Diagnosis("explained", {finding}), nullptr).named);
  finding["order"] = 37.0;
  EXPECT_FALSE(ScoreCase(answer, Diagnosis("explained", {finding}), nullptr).named);
}

TEST(ProofScore, AnythingButGeometryIsAFalseAlarmWhereNothingIsLeftOut) {
  EXPECT_FALSE(ScoreCase(NullAnswer(), Diagnosis("consistent", {}), nullptr).false_alarm);
  EXPECT_TRUE(ScoreCase(NullAnswer(), Diagnosis("unexplained", {}), nullptr).false_alarm);
  const Json geometry = Diagnosis("explained", {FindingOf("axis_tilt", 2, "geometry")});
  EXPECT_FALSE(ScoreCase(NullAnswer(), geometry, nullptr).false_alarm);
  const Json named = Diagnosis("explained", {FindingOf("backlash", 2, "C4")});
  const ProofScore score = ScoreCase(NullAnswer(), named, nullptr);
  EXPECT_TRUE(score.false_alarm);
  EXPECT_TRUE(score.wrong_single);
}

TEST(ProofScore, AMissedDetectableCauseIsATruthExcluded) {
  const ProofScore missed = ScoreCase(Answer(), Diagnosis("consistent", {}), nullptr);
  EXPECT_FALSE(missed.truth_kept);
  EXPECT_FALSE(missed.named);
  Json faint = Answer();
  faint["causes"][0]["power"] = 0.3;
  EXPECT_TRUE(ScoreCase(faint, Diagnosis("consistent", {}), nullptr).truth_kept);
}

TEST(ProofScore, CountsIntervalsThatHoldTheTruth) {
  Json finding = FindingOf("joint_compliance", 2, "C1");
  finding["parameters"].push_back(
      {{"name", "joint_compliance.2.compliance"}, {"ci95", {2.9e-6, 3.1e-6}}});
  const ProofScore inside = ScoreCase(Answer(), Diagnosis("explained", {finding}), nullptr);
  EXPECT_EQ(inside.intervals, 1);
  EXPECT_EQ(inside.covered, 1);
  finding["parameters"][0]["ci95"] = {1e-6, 2e-6};
  const ProofScore outside = ScoreCase(Answer(), Diagnosis("explained", {finding}), nullptr);
  EXPECT_EQ(outside.intervals, 1);
  EXPECT_EQ(outside.covered, 0);
}

TEST(ProofFigures, SayWhichBarIsNotReached) {
  ProofScore right;
  right.scenario = "D1";
  right.group = "null";
  right.library_has_all = true;
  ProofScore wrong = right;
  wrong.false_alarm = true;
  const std::vector<ProofFigure> figures = Figures({right, wrong});
  EXPECT_EQ(figures.front().name, "false_alarm");
  EXPECT_DOUBLE_EQ(figures.front().value, 0.5);
  EXPECT_FALSE(figures.front().reached());
  EXPECT_THAT(ProofTable({right, wrong}), testing::HasSubstr("NOT REACHED"));
}

/// The suite in a scratch folder.
class Suite : public ::testing::Test {
 protected:
  void SetUp() override {
    options_.folder = folder_.path();
    options_.program = DHCAL_PROGRAM;
    options_.jobs = 2;
  }

  std::vector<ProofScore> Run() const {
    return RunProof(options_, [](int /*done*/, int /*all*/) {});
  }

  const TempFolder folder_;
  ProofOptions options_;
};

TEST_F(Suite, GoesOnWhereItWasStopped) {
  if (kSanitized) GTEST_SKIP() << "the test of the changed answer runs the same code";
  options_.only = {"D4"};
  options_.seeds = 1;
  ASSERT_EQ(Run().front().failure, "");
  const fs::path result = options_.folder / "results" / "D4_kr15_01" / "result.json";
  const auto written = fs::last_write_time(result);
  const std::vector<ProofScore> again = Run();
  EXPECT_EQ(fs::last_write_time(result), written);
  EXPECT_TRUE(again.front().named);
}

TEST_F(Suite, RefusesAnAnswerThatWasChangedAfterTheCaseWasMade) {
  options_.only = {"D1"};
  options_.seeds = 1;
  ASSERT_EQ(Run().front().failure, "");
  std::ofstream(options_.folder / "sealed" / "D1_kr15_01.json", std::ios::app) << " ";
  EXPECT_THAT(Run().front().failure, testing::HasSubstr("is not the answer"));
}

TEST_F(Suite, QuickReachesItsBars) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  options_.quick = true;
  const std::vector<ProofScore> scores = Run();
  ASSERT_GE(scores.size(), 10);
  for (const ProofScore& score : scores) EXPECT_EQ(score.failure, "") << score.name;
  for (const ProofFigure& figure : Figures(scores)) {
    EXPECT_TRUE(figure.reached()) << figure.title << ": " << figure.value << "\n"
                                  << ProofTable(scores);
  }
}

}  // namespace
}  // namespace dhcal
