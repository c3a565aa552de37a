#include <limits>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "problems/formats/result/result_writer.h"
#include "tests/support/comma_locale.h"
#include "tests/support/example_result.h"

namespace dhcal {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

std::set<std::string> Keys(const json& object) {
  std::set<std::string> keys;
  for (const auto& item : object.items()) keys.insert(item.key());
  return keys;
}

json Parsed(const Result& result) { return json::parse(ResultToJson(result)); }

TEST(ResultToJson, HasTheKeysOfSchemaOne) {
  const json root = Parsed(ExampleResult());
  EXPECT_EQ(root["schema"], 1);
  EXPECT_THAT(Keys(root),
              UnorderedElementsAre("schema",
                                   "problem",
                                   "program_version",
                                   "kind",
                                   "simulated",
                                   "rows",
                                   "rows_test",
                                   "num_poses",
                                   "noise_sigma_m",
                                   "noise_source",
                                   "best_fit",
                                   "intervals",
                                   "fits",
                                   "comparison",
                                   "baseline",
                                   "validation",
                                   "setup",
                                   "notes"));
  EXPECT_THAT(Keys(root["setup"]),
              UnorderedElementsAre("plausible", "reasons", "causes", "cured", "remarks"));
  EXPECT_THAT(Keys(root["baseline"]), UnorderedElementsAre("nominal", "base_and_tool_only"));
  EXPECT_THAT(Keys(root["baseline"]["nominal"]),
              UnorderedElementsAre("rms_m", "rms_point_m", "max_point_m"));
  EXPECT_THAT(Keys(root["validation"]),
              UnorderedElementsAre("method",
                                   "rows",
                                   "rms_train_m",
                                   "rms_test_m",
                                   "rms_point_test_m",
                                   "max_point_test_m",
                                   "noise_sigma_m"));
  EXPECT_THAT(Keys(root["comparison"]), UnorderedElementsAre("parameters"));
  EXPECT_THAT(Keys(root["comparison"]["parameters"][0]),
              UnorderedElementsAre("name",
                                   "unit",
                                   "svd_gauss_newton",
                                   "levenberg_marquardt",
                                   "difference",
                                   "in_null_space"));
}

TEST(ResultToJson, HasTheLowerTriangleOfTheCovariance) {
  Result result = ExampleResult();
  result.fits[0].covariance.resize(2, 2);
  result.fits[0].covariance << 4e-10, -1e-10, -1e-10, 9e-10;
  const json expected = json::parse("[[4e-10], [-1e-10, 9e-10]]");
  EXPECT_EQ(Parsed(result)["fits"][0]["covariance"], expected);
}

TEST(ResultToJson, HasTheKeysOfAFit) {
  const json fit = Parsed(ExampleResult())["fits"][0];
  EXPECT_THAT(Keys(fit),
              UnorderedElementsAre("solver",
                                   "converged",
                                   "usable",
                                   "termination",
                                   "message",
                                   "iterations",
                                   "rank",
                                   "rank_numerical",
                                   "columns",
                                   "kappa_norm",
                                   "cost",
                                   "chi2_reduced",
                                   "chi2_p",
                                   "seconds",
                                   "rms_m",
                                   "rms_point_m",
                                   "max_point_m",
                                   "singular_values",
                                   "singular_values_of",
                                   "truncation_cut",
                                   "condition_number",
                                   "observability",
                                   "trace",
                                   "parameters",
                                   "null_space",
                                   "covariance_check",
                                   "covariance_difference"));
  EXPECT_THAT(Keys(fit["observability"]), UnorderedElementsAre("O1", "O2", "O3", "O4", "O5"));
  EXPECT_THAT(Keys(fit["trace"][0]),
              UnorderedElementsAre("iteration", "cost", "kappa_norm", "rank", "step_norm"));
  EXPECT_THAT(Keys(fit["parameters"][0]),
              UnorderedElementsAre("name",
                                   "unit",
                                   "nominal",
                                   "correction",
                                   "value",
                                   "sigma",
                                   "ci95",
                                   "verdict",
                                   "confounded_with",
                                   "explanation"));
  EXPECT_THAT(Keys(fit["null_space"][0]), UnorderedElementsAre("direction", "explanation"));
  EXPECT_THAT(Keys(fit["null_space"][0]["direction"][0]), UnorderedElementsAre("name", "weight"));
}

TEST(ResultToJson, GivesNumbersBackToTheLastBit) {
  const Result result = ExampleResult();
  const json root = Parsed(result);
  const ParameterResult& expected = result.fits[0].parameters[3];
  const json& parameter = root["fits"][0]["parameters"][3];
  EXPECT_EQ(parameter["name"], expected.name);
  EXPECT_EQ(parameter["unit"], "rad");
  EXPECT_EQ(parameter["verdict"], "identified");
  EXPECT_EQ(parameter["value"].get<double>(), expected.value);
  EXPECT_EQ(parameter["ci95"][1].get<double>(), expected.ci95_high);
  EXPECT_EQ(root["fits"][1]["solver"], "levenberg_marquardt");
  EXPECT_EQ(root["fits"][0]["termination"], "small_change");
  EXPECT_THAT(root["fits"][0]["message"].get<std::string>(), HasSubstr("below their tolerances"));
  EXPECT_EQ(root["fits"][0]["null_space"][1]["direction"][1]["weight"], -1.0);
}

TEST(ResultToJson, LeavesOutWhatWasNotComputed) {
  const json root = Parsed(Result());
  EXPECT_THAT(Keys(root),
              UnorderedElementsAre("schema",
                                   "problem",
                                   "program_version",
                                   "kind",
                                   "simulated",
                                   "fits",
                                   "baseline",
                                   "setup",
                                   "notes"));
  const json parameter = Parsed(ExampleResult())["fits"][0]["parameters"][11];
  EXPECT_EQ(parameter["verdict"], "fixed");
  EXPECT_FALSE(parameter.contains("sigma"));
  EXPECT_FALSE(parameter.contains("ci95"));
}

TEST(ResultToJson, GivesNoParametersOfAFitThatIsNotUsable) {
  Result result = DivergedResult();
  result.fits[0].parameters = ExampleParameters();
  const json fit = Parsed(result)["fits"][0];
  EXPECT_FALSE(fit.contains("parameters"));
  EXPECT_FALSE(fit.contains("null_space"));
  EXPECT_EQ(fit["converged"], false);
  EXPECT_EQ(fit["termination"], "diverged");
  EXPECT_FALSE(fit["trace"][0].contains("kappa_norm"));
}

TEST(ResultToJson, NeverHoldsNanOrNull) {
  Result result = ExampleResult();
  result.fits[0].condition_number = std::numeric_limits<double>::infinity();
  result.fits[0].singular_values[2] = kNotSet;
  result.fits[0].null_space[0].direction[0].weight = kNotSet;
  for (const Result& each : {result, DivergedResult(), Result()}) {
    const std::string text = ResultToJson(each);
    EXPECT_THAT(text, Not(HasSubstr("null,")));
    EXPECT_THAT(text, Not(HasSubstr("null\n")));
    EXPECT_THAT(text, Not(testing::ContainsRegex("[^a-z](nan|inf)[^a-z]")));
    EXPECT_FALSE(json::parse(text).is_discarded());
  }
}

TEST(ResultToJson, SurvivesNamesThatAreNotUtf8) {
  Result result = ExampleResult();
  result.problem = "caf\xe9";
  EXPECT_EQ(Parsed(result)["problem"], "caf\xef\xbf\xbd");
}

TEST(ResultToJson, IsTheSameUnderACommaDecimalLocale) {
  const std::string expected = ResultToJson(ExampleResult());
  const CommaLocale locale;
  EXPECT_EQ(ResultToJson(ExampleResult()), expected);
}

}  // namespace
}  // namespace dhcal
