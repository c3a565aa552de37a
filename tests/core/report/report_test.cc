#include "core/report/report.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/text.h"
#include "core/report/text_renderer.h"
#include "tests/support/comma_locale.h"
#include "tests/support/example_result.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

std::string TextReport(const ProblemSpec& spec, const Result& result) {
  return ToText(ReportOf(spec, ExampleRecording(), result));
}

void ExpectFits(const std::string& report) {
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(CountCharacters(line), 100) << line;
    EXPECT_TRUE(line.empty() || line.back() != ' ') << "trailing space: " << line;
  }
}

std::size_t CountLines(const std::string& report) {
  return static_cast<std::size_t>(std::count(report.begin(), report.end(), '\n'));
}

/// Many runs with their own base, long names, long traces, a large null space.
Result HugeResult() {
  Result result = ExampleResult();
  result.problem = std::string(300, 'x');
  FitResult& fit = result.fits[0];
  fit.trace.assign(1000, {7, 1e-123, 1e-11, 123456, 1e100});
  fit.parameters.clear();
  for (int run = 0; run < 1000; ++run) {
    const std::string name = "base_rx.a run with a rather long name, number " + std::to_string(run);
    ParameterResult parameter = ExampleParameter(name, Unit::kRadian, run);
    parameter.correction = -std::pow(10.0, run % 30 - 15);
    parameter.sigma = std::pow(10.0, run % 40 - 20);
    parameter.verdict = run % 3 == 0 ? Verdict::kConfounded : Verdict::kFixed;
    parameter.confounded_with.assign(500, "d1");
    parameter.explanation = std::string(250, 'e') + " and so on";
    fit.parameters.push_back(parameter);
  }
  fit.null_space.assign(300, {{500, {"alpha1.long name of a run", -0.123456}}, "Because."});
  fit.singular_values.assign(6000, 1.5);
  result.notes.assign(400, "A note.");
  result.residuals.assign(100000, result.residuals[3]);
  return result;
}

TEST(TextReport, MatchesTheGoldenFile) {
  const std::string file = DHCAL_SOURCE_DIR "/tests/data/golden/report_kr15.txt";
  const std::string report = TextReport(ExampleSpec(), ExampleResult());
  if (std::getenv("DHCAL_UPDATE_GOLDEN") != nullptr) WriteFile(file, report);
  EXPECT_EQ(report, ReadFile(file)) << "when the change is meant, run the test once with "
                                       "DHCAL_UPDATE_GOLDEN=1 and review the file's diff";
}

TEST(TextReport, IsAtMostAHundredColumnsWide) {
  ExpectFits(TextReport(ExampleSpec(), ExampleResult()));
  ExpectFits(TextReport(ExampleSpec(), DivergedResult()));
  ExpectFits(TextReport(ExampleSpec(), HugeResult()));
  ExpectFits(TextReport(ProblemSpec(), Result()));
}

TEST(TextReport, CountsCharactersAndNotBytes) {
  ProblemSpec spec = ExampleSpec();
  Result result = ExampleResult();
  for (int i = 0; i < 40; ++i) spec.robot.name += "\u00fc\u00f6 \u20ac";
  result.problem = spec.robot.name + spec.robot.name;
  result.residuals[1].run = spec.robot.name;
  const std::string report = TextReport(spec, result);
  ExpectFits(report);
  EXPECT_FALSE(FindInvalidUtf8(report).has_value());
}

TEST(TextReport, IsNotFloodedByALargeResult) {
  const std::string report = TextReport(ExampleSpec(), HugeResult());
  EXPECT_LT(CountLines(report), 600u);
  EXPECT_THAT(report, HasSubstr("... and 984 more in result.json"));  // iterations
  EXPECT_THAT(report, HasSubstr("... and 284 more in result.json"));  // null directions
  EXPECT_THAT(report, HasSubstr("... and 492 more in result.json"));  // entries of each
  EXPECT_THAT(report, HasSubstr("... and 294 more in result.json"));  // doubtful parameters
  EXPECT_THAT(report, HasSubstr("... and 380 more in result.json"));  // notes
}

TEST(TextReport, IsTheSameUnderACommaDecimalLocale) {
  const std::string expected = TextReport(ExampleSpec(), ExampleResult());
  const CommaLocale locale;
  EXPECT_EQ(TextReport(ExampleSpec(), ExampleResult()), expected);
}

TEST(TextReport, GivesTheAnswerBeforeTheDetails) {
  const std::string report = TextReport(ExampleSpec(), ExampleResult());
  EXPECT_THAT(report, HasSubstr("(base and tool"));
  EXPECT_LT(report.find("RESULT"), report.find("PARAMETERS"));
  EXPECT_LT(report.find("PARAMETERS"), report.find("WHAT THIS DATA CANNOT DETERMINE"));
  EXPECT_LT(report.find("WHAT THIS DATA CANNOT DETERMINE"), report.find("APPENDIX: SOLVERS"));
}

TEST(TextReport, ComparesWithTheNominalParametersWhereBaseAndToolWereNotFitted) {
  Result result = ExampleResult();
  result.base_and_tool_only.reset();
  EXPECT_THAT(TextReport(ExampleSpec(), result),
              ContainsRegex("2\\.600 mm with the nominal[[:space:]]+parameters"));
}

TEST(TextReport, PrintsNoParametersWithoutAUsableFit) {
  const std::string report = TextReport(ExampleSpec(), DivergedResult());
  EXPECT_THAT(report, AllOf(HasSubstr("NO USABLE RESULT"), HasSubstr("The cost grew from 17")));
  EXPECT_THAT(report, AllOf(Not(HasSubstr("PARAMETERS")), Not(HasSubstr("theta1"))));
}

TEST(TextReport, SaysThatASolverWasNotRun) {
  Result result;
  result.fits.resize(1);
  const std::string report = TextReport(ProblemSpec(), result);
  EXPECT_THAT(report, AllOf(HasSubstr("not run"), HasSubstr("The solver was not called.")));
  EXPECT_THAT(report, Not(HasSubstr("nan")));
}

TEST(TextReport, ListsTheFiveWorstRows) {
  Result result = ExampleResult();
  result.residuals[4].sigmas = 9.75;
  result.residuals[4].length = 5e-4;
  const std::string report = TextReport(ExampleSpec(), result);
  const std::string section = report.substr(report.find("LARGEST RESIDUALS"));
  EXPECT_THAT(section, testing::ContainsRegex("  5  morning  fitted +0.5000 +9.8\n"));
  EXPECT_EQ(CountLines(section.substr(0, section.find("NOTES"))), 2u + 2u + 5u + 1u);
}

TEST(TextReport, SeparatesDifferencesThatNoReadingSees) {
  const std::string report = TextReport(ExampleSpec(), ExampleResult());
  EXPECT_THAT(report, HasSubstr("THE TWO SOLVERS COMPARED"));
  EXPECT_THAT(report, HasSubstr("inside the null space"));
  EXPECT_THAT(report, HasSubstr("4.0e-02 mm (d2)"));
}

TEST(TextReport, AdvisesHowToValidateWhenNothingWasKeptUnseen) {
  Result result = ExampleResult();
  result.validation = ValidationResult();
  EXPECT_THAT(TextReport(ExampleSpec(), result), HasSubstr("value test in a column set"));
}

TEST(TextReport, LetsNoControlCharacterThrough) {
  Result result = ExampleResult();
  result.notes = {"a\x1b[31mb\r\nc\td"};
  EXPECT_THAT(TextReport(ExampleSpec(), result), HasSubstr("  - a [31mb c d\n"));
}

}  // namespace
}  // namespace dhcal
