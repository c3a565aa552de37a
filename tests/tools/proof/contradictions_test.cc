// What a report may not say, in the words of result.json.

#include "tools/proof/contradictions.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dhcal {
namespace {

using Json = nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Json SoundFinding() {
  return Json::parse(R"({"effect": "backlash", "joint": 4, "class": "C4", "confusable_with": [],
    "p_value": 1e-6, "cautions": [], "parameters": [{"name": "backlash.4.width", "value": 1e-4,
    "sigma": 1e-5, "ci95": [8e-5, 1.2e-4]}]})");
}

Json SoundDiagnosis() {
  Json d = Json::parse(R"({"verdict": "explained", "false_alarm": 0.01, "moved_parameters": [],
    "misfit": {"p_value": 1e-6, "outliers": 1, "outlier_rows": [7]}})");
  d["findings"] = Json::array({SoundFinding()});
  return d;
}

TEST(Contradictions, ASoundReportHasNone) {
  EXPECT_THAT(ContradictionsIn(SoundDiagnosis()), IsEmpty());
  Json consistent = SoundDiagnosis();
  consistent["verdict"] = "consistent";
  consistent["findings"] = Json::array();
  consistent["misfit"]["p_value"] = 0.4;
  EXPECT_THAT(ContradictionsIn(consistent), IsEmpty());
}

TEST(Contradictions, AFindingMustBeSure) {
  Json d = SoundDiagnosis();
  d["findings"][0]["p_value"] = 0.2;
  EXPECT_THAT(ContradictionsIn(d), Contains(HasSubstr("above the rate of false alarms")));
  d = SoundDiagnosis();
  d["findings"][0]["parameters"][0]["sigma"] = 9e-5;
  EXPECT_THAT(ContradictionsIn(d), Contains(HasSubstr("two deviations")));
  d = SoundDiagnosis();
  d["findings"][0]["parameters"][0]["ci95"] = {2e-4, 3e-4};
  EXPECT_THAT(ContradictionsIn(d), Contains(HasSubstr("does not hold its value")));
  d = SoundDiagnosis();
  d["findings"][0]["cautions"] =
      Json::array({"compliance is negative, which no such mechanism can be"});
  EXPECT_THAT(ContradictionsIn(d), Contains(HasSubstr("negative")));
}

TEST(Contradictions, TheVerdictGoesWithTheFindings) {
  for (const char* const verdict : {"consistent", "partly_explained", "ambiguous", "unexplained"}) {
    Json d = SoundDiagnosis();
    d["verdict"] = verdict;
    EXPECT_THAT(ContradictionsIn(d), Contains(HasSubstr(verdict)));
  }
  Json d = SoundDiagnosis();
  d["unexplained"] = {{"fraction", 0.4}};
  EXPECT_THAT(ContradictionsIn(d), Contains(HasSubstr("something is unexplained")));
}

TEST(Contradictions, TotalsAddUp) {
  Json d = SoundDiagnosis();
  d["misfit"]["outliers"] = 3;
  EXPECT_THAT(ContradictionsIn(d), Contains(HasSubstr("set aside")));
  d = SoundDiagnosis();
  d["verdict"] = "partly_explained";
  d["unexplained"] = {{"fraction", 1.7}};
  EXPECT_THAT(ContradictionsIn(d), Contains(HasSubstr("a fraction of 1.7")));
}

}  // namespace
}  // namespace dhcal
