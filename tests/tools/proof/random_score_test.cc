// How a diagnosis of a random trial is held against the sealed answer.

#include "tools/proof/random_score.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/proof/random_rates.h"
#include "tools/proof/random_table.h"

namespace dhcal {
namespace {

using Json = nlohmann::json;

Json CauseOf(const std::string& effect, int joint, double power = 1) {
  return {{"effect", effect},
          {"joint", joint},
          {"also", Json::array()},
          {"same", Json::array()},
          {"visible_sigmas", 2.0},
          {"power", power}};
}

Json AnswerWith(const std::vector<Json>& causes) {
  Json answer = {{"name", "R_00001"},
                 {"seed", 1},
                 {"settings", {{"sigma", "given"}, {"kind", "position"}}},
                 {"geometry", Json::array()},
                 {"causes", Json::array()}};
  for (const Json& cause : causes) answer["causes"].push_back(cause);
  return answer;
}

Json Name(const std::string& effect, int joint) { return {{"effect", effect}, {"joint", joint}}; }

Json Found(const std::string& effect, int joint, const std::string& effect_class = "C1") {
  return {{"effect", effect},
          {"joint", joint},
          {"class", effect_class},
          {"confusable_with", Json::array()},
          {"cautions", Json::array()},
          {"parameters", Json::array()}};
}

Json ResultWith(const std::string& verdict, const std::vector<Json>& findings) {
  Json hypothesis = {{"kept", true}, {"effects", Json::array()}};
  for (const Json& finding : findings) hypothesis["effects"].push_back(finding);
  Json diagnosis = {{"verdict", verdict},
                    {"misfit", {{"outlier_rows", Json::array()}}},
                    {"moved_parameters", Json::array()},
                    {"findings", findings},
                    {"hypotheses", Json::array({hypothesis})}};
  return {{"diagnosis", diagnosis}};
}

TEST(RandomScores, RightAloneNeedsAllCausesAndNothingElse) {
  const Json answer = AnswerWith({CauseOf("joint_compliance", 2), CauseOf("backlash", 4)});
  const RandomScore both = ScoreRandomCase(
      answer, ResultWith("explained", {Found("joint_compliance", 2), Found("backlash", 4)}));
  EXPECT_TRUE(both.judged);
  EXPECT_TRUE(both.alone);
  EXPECT_TRUE(both.listed);
  EXPECT_FALSE(both.extra);
  const RandomScore one =
      ScoreRandomCase(answer, ResultWith("explained", {Found("joint_compliance", 2)}));
  EXPECT_FALSE(one.alone);
  EXPECT_FALSE(one.listed);
  EXPECT_FALSE(one.wrong_single) << "half of the truth is no wrong name";
}

TEST(RandomScores, ANameTooManyIsExtraBesideTheTruthAndWrongWithoutIt) {
  const Json answer = AnswerWith({CauseOf("joint_compliance", 2)});
  const RandomScore beside = ScoreRandomCase(
      answer, ResultWith("explained", {Found("joint_compliance", 2), Found("backlash", 4)}));
  EXPECT_TRUE(beside.extra);
  EXPECT_FALSE(beside.alone);
  EXPECT_FALSE(beside.wrong_single);
  const RandomScore without =
      ScoreRandomCase(answer, ResultWith("explained", {Found("backlash", 4)}));
  EXPECT_TRUE(without.wrong_single);
  EXPECT_FALSE(without.extra);
}

TEST(RandomScores, ATruthAmongAlternativesOrKeptHypothesesIsListed) {
  const Json answer = AnswerWith({CauseOf("joint_compliance", 2)});
  Json finding = Found("base_compliance", 0);
  finding["confusable_with"] = Json::array({Name("joint_compliance", 2)});
  const RandomScore offered = ScoreRandomCase(answer, ResultWith("ambiguous", {finding}));
  EXPECT_TRUE(offered.listed);
  EXPECT_FALSE(offered.alone);
  EXPECT_FALSE(offered.extra) << "it offers the truth";
  Json result = ResultWith("ambiguous", {Found("backlash", 4)});
  result["diagnosis"]["hypotheses"].push_back(
      {{"kept", true}, {"effects", {Name("joint_compliance", 2)}}});
  EXPECT_TRUE(ScoreRandomCase(answer, result).listed);
  EXPECT_EQ(ScoreRandomCase(answer, result).kept, 2);
  result["diagnosis"]["hypotheses"][1]["kept"] = false;
  EXPECT_FALSE(ScoreRandomCase(answer, result).listed);
}

TEST(RandomScores, EquivalentNamesCountAtTheirOwnPlaceOnly) {
  Json gear = CauseOf("gear_harmonic", 3);
  gear["also"] = Json::array({"transmission_error"});
  const Json answer = AnswerWith({gear});
  EXPECT_TRUE(
      ScoreRandomCase(answer, ResultWith("explained", {Found("transmission_error", 3)})).alone);
  EXPECT_FALSE(
      ScoreRandomCase(answer, ResultWith("explained", {Found("transmission_error", 2)})).alone);
  Json step = CauseOf("joint_step", 1);
  step["same"] = Json::array({Name("base_step", 0)});
  EXPECT_TRUE(
      ScoreRandomCase(AnswerWith({step}), ResultWith("explained", {Found("base_step", 0)})).alone);
}

TEST(RandomScores, WhatCannotBeSeenNeedNotBeFoundAndMay) {
  const Json answer = AnswerWith({CauseOf("backlash", 4), CauseOf("joint_gain", 2, 0.2)});
  const RandomScore without =
      ScoreRandomCase(answer, ResultWith("explained", {Found("backlash", 4)}));
  EXPECT_TRUE(without.alone);
  const RandomScore with = ScoreRandomCase(
      answer, ResultWith("explained", {Found("backlash", 4), Found("joint_gain", 2)}));
  EXPECT_TRUE(with.alone);
  EXPECT_FALSE(
      ScoreRandomCase(AnswerWith({CauseOf("joint_gain", 2, 0.2)}), ResultWith("consistent", {}))
          .judged);
}

TEST(RandomScores, OutsideTheLibraryOnlyAWrongNameIsWrong) {
  Json tooth = CauseOf("", 3);
  tooth["also"] = Json::array({"transmission_error"});
  const Json answer = AnswerWith({tooth});
  const RandomScore unexplained = ScoreRandomCase(answer, ResultWith("unexplained", {}));
  EXPECT_TRUE(unexplained.outside);
  EXPECT_FALSE(unexplained.judged);
  EXPECT_FALSE(unexplained.wrong_single);
  EXPECT_TRUE(
      ScoreRandomCase(answer, ResultWith("explained", {Found("backlash", 3)})).wrong_single);
  EXPECT_FALSE(ScoreRandomCase(answer, ResultWith("explained", {Found("transmission_error", 3)}))
                   .wrong_single);
}

TEST(RandomScores, WithNothingLeftOutOnlyConsistentIsRight) {
  const Json answer = AnswerWith({});
  EXPECT_FALSE(ScoreRandomCase(answer, ResultWith("consistent", {})).false_alarm);
  EXPECT_TRUE(ScoreRandomCase(answer, ResultWith("unexplained", {})).false_alarm);
  EXPECT_TRUE(ScoreRandomCase(answer, ResultWith("explained", {Found("backlash", 3)})).false_alarm);
}

TEST(RandomScores, GeometryThatIsOffMayBeNamedAndNoOther) {
  Json answer = AnswerWith({});
  answer["geometry"] = Json::array({"tool_offset"});
  const Json tool = Found("tool_offset", 0, "geometry"), base = Found("base_frame", 0, "geometry");
  const RandomScore right = ScoreRandomCase(answer, ResultWith("explained", {tool}));
  EXPECT_FALSE(right.false_alarm);
  EXPECT_FALSE(right.geometry_extra);
  EXPECT_TRUE(ScoreRandomCase(answer, ResultWith("explained", {base})).geometry_extra);
  const Json runs = AnswerWith({CauseOf("base_per_run", 0)});
  const RandomScore moved =
      ScoreRandomCase(runs, ResultWith("explained", {Found("base_per_run", 0, "geometry"), base}));
  EXPECT_TRUE(moved.alone);
  EXPECT_FALSE(moved.geometry_extra);
  Json offering = Found("base_per_run", 0, "geometry");
  offering["confusable_with"] = Json::array({Name("base_step", 0)});
  const RandomScore offered =
      ScoreRandomCase(AnswerWith({CauseOf("base_step", 0)}), ResultWith("ambiguous", {offering}));
  EXPECT_FALSE(offered.geometry_extra);
  EXPECT_TRUE(offered.listed);
}

TEST(RandomTables, GiveRatesWithIntervalsAndSayWhichBarIsNotReached) {
  const RandomScore right = ScoreRandomCase(AnswerWith({CauseOf("backlash", 4)}),
                                            ResultWith("explained", {Found("backlash", 4)}));
  const RandomScore wrong = ScoreRandomCase(AnswerWith({CauseOf("backlash", 4)}),
                                            ResultWith("explained", {Found("joint_gain", 4)}));
  const std::vector<RandomRate> rates = RandomRates({right, wrong});
  EXPECT_EQ(rates[0].name, "right_or_listed");
  EXPECT_EQ(rates[0].hits, 1);
  EXPECT_EQ(rates[0].trials, 2);
  EXPECT_FALSE(rates[0].reached());
  const std::string table = RandomTable({right, wrong});
  EXPECT_THAT(table, testing::HasSubstr("1/2 50 % (9-91)"));
  EXPECT_THAT(table, testing::HasSubstr("NOT REACHED"));
  EXPECT_THAT(table, testing::HasSubstr("rms/sigma 1 to 3"));
}

}  // namespace
}  // namespace dhcal
