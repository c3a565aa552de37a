#include "core/report/first_screen.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/text_renderer.h"
#include "tests/support/example_result.h"

namespace dhcal {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string Screen(const Result& result) { return ToText(FirstScreenOf(result, "out")); }

/// The example with ten findings.
Result WithFindings(DiagnosisVerdict verdict) {
  Result result = ExampleResult();
  result.diagnosis.emplace();
  result.diagnosis->verdict = verdict;
  result.diagnosis->summary = "a summary";
  for (int k = 1; k <= 10; ++k) {
    Finding finding;
    finding.sentence = "joint " + std::to_string(k) + " is something";
    result.diagnosis->findings.push_back(finding);
  }
  return result;
}

TEST(FirstScreen, FitsAScreenAndEndsWithTheFiles) {
  Result result = WithFindings(DiagnosisVerdict::kExplained);
  result.setup.remarks.assign(50, "A remark.");
  result.notes.assign(50, "A note.");
  result.rows_set_aside.assign(50, {});
  const std::string text = Screen(result);
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 40);
  EXPECT_THAT(text, HasSubstr("UNMODELLED EFFECTS: EXPLAINED"));
  EXPECT_THAT(text,
              AllOf(HasSubstr("6. Joint 6 is something."), HasSubstr("4 more in report.txt")));
  EXPECT_THAT(text, HasSubstr("46 more in report.txt"));
  EXPECT_THAT(text, HasSubstr("Files"));
  EXPECT_GT(text.find("out/: calibrated.yaml"), text.find("Next"));
}

TEST(FirstScreen, NamesExcludedRowsWithHowFarTheyAreOff) {
  Result result = ExampleResult();
  result.rows_set_aside = {{16, false, "a round length off", 10e-3}, {42, true, "", kNotSet}};
  EXPECT_THAT(Screen(result), HasSubstr("Excluded rows 17 (10.00 mm off), 43\n"));
}

TEST(FirstScreen, SaysWhatToMeasureWhereTheVerdictIsOpen) {
  Result result = WithFindings(DiagnosisVerdict::kAmbiguous);
  Finding& first = result.diagnosis->findings[0];
  first.confusable_with.emplace_back();
  first.confusable_with[0].effect.effect = "backlash";
  first.confusable_with[0].effect.joint = 4;
  first.separating_advice = "to tell it from x: other poses";
  EXPECT_THAT(Screen(result), HasSubstr("Measure, to tell it from x: other poses."));
  EXPECT_THAT(Screen(result),
              HasSubstr("1. Joint 1 is something. Or instead: backlash at joint 4."));
  EXPECT_THAT(Screen(WithFindings(DiagnosisVerdict::kExplained)), Not(HasSubstr("Measure,")));
}

TEST(FirstScreen, WithoutAResultHoldsTheReasonsAndNoParameters) {
  Result result = DivergedResult();
  result.notes = {"The reason."};
  const std::string text = Screen(result);
  EXPECT_THAT(text, AllOf(HasSubstr("NO USABLE RESULT"), HasSubstr("The reason.")));
  EXPECT_THAT(text, HasSubstr("The cost grew from 17"));
  EXPECT_THAT(text, AllOf(Not(HasSubstr("calibrated.yaml,")), Not(HasSubstr("Next"))));
}

TEST(FirstScreen, OfFilesThatDoNotBelongTogetherIsTheCauseAndItsCure) {
  Result result = ExampleResult();
  result.best_fit = -1;
  result.setup.plausible = false;
  result.setup.reasons = {"Far off."};
  SetupCause cause;
  cause.sentence = "Joint 2 counts the other way.";
  cause.text = "sign: -1";
  result.setup.causes = {cause};
  const std::string text = Screen(result);
  EXPECT_THAT(text, AllOf(HasSubstr("IMPLAUSIBLE"), HasSubstr("Write sign: -1")));
  EXPECT_THAT(text, Not(HasSubstr("NO USABLE RESULT")));
}

}  // namespace
}  // namespace dhcal
