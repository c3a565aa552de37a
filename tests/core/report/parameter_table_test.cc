#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/sections.h"
#include "core/report/text_renderer.h"
#include "tests/support/example_result.h"

namespace dhcal {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

std::string ParameterText(const Result& result) { return ToText(ParameterSection(result)); }

/// The example with these parameters.
Result WithParameters(std::vector<ParameterResult> parameters) {
  Result result = ExampleResult();
  result.fits[0].parameters = std::move(parameters);
  return result;
}

ParameterResult Identified(const std::string& name, Unit unit, double correction, double sigma) {
  ParameterResult parameter;
  parameter.name = name;
  parameter.unit = unit;
  parameter.nominal = unit == Unit::kRadian ? kPi / 2 : 0.65;
  parameter.correction = correction;
  parameter.value = parameter.nominal + correction;
  parameter.sigma = sigma;
  parameter.ci95_low = parameter.value - 2 * sigma;
  parameter.ci95_high = parameter.value + 2 * sigma;
  parameter.verdict = Verdict::kIdentified;
  return parameter;
}

TEST(ParameterSection, PrintsTableThreeOfThePaperToItsDigits) {
  Result result = WithParameters({Identified("theta1", Unit::kRadian, 870e-6, 2e-16),
                                  Identified("theta5", Unit::kRadian, -806.99e-6, 3e-13),
                                  Identified("alpha5", Unit::kRadian, 463.89e-6, kNotSet),
                                  Identified("a5", Unit::kMetre, 62.98e-6, 3e-13),
                                  Identified("d2", Unit::kMetre, -68.81e-6, 3.1e-4)});
  result.noise_free = true;
  const std::string text = ParameterText(result);
  EXPECT_THAT(text, HasSubstr("[urad]"));
  EXPECT_THAT(text, HasSubstr("[um]"));
  EXPECT_THAT(text, ContainsRegex("theta1 +[0-9.]+ +870\\.000 +2\\.0e-10"));
  EXPECT_THAT(text, ContainsRegex("theta5 +[0-9.]+ +-806\\.990 +3\\.0e-07"));
  EXPECT_THAT(text, ContainsRegex("alpha5 +[0-9.]+ +463\\.890 +- "));
  EXPECT_THAT(text, ContainsRegex("a5 +[0-9.]+ +62\\.980"));
  EXPECT_THAT(text, ContainsRegex("d2 +[0-9.]+ +-69 +310"));
}

TEST(ParameterSection, ShowsTwoDigitsOfSigmaAndAsManyDecimalsOfTheCorrection) {
  const std::string text =
      ParameterText(WithParameters({Identified("theta1", Unit::kRadian, 0.87654e-3, 0.01234e-3),
                                    Identified("a1", Unit::kMetre, 0.98765e-3, 0.1234e-3)}));
  EXPECT_THAT(text,
              ContainsRegex("theta1 +90\\.00000 +0\\.877 +0\\.012 +0\\.852 +0\\.901 "
                            "+90\\.05022 +identified"));
  EXPECT_THAT(text, ContainsRegex("a1 +650\\.00 +0\\.99 +0\\.12 +0\\.74 +1\\.23 +650\\.99"));
}

TEST(ParameterSection, NamesFixedParametersInOneSentence) {
  ParameterResult fixed;
  fixed.verdict = Verdict::kFixed;
  std::vector<ParameterResult> parameters = {Identified("a1", Unit::kMetre, 1e-4, 1e-5)};
  for (int i = 0; i < 100; ++i) {
    fixed.name = "fixed" + std::to_string(i);
    parameters.push_back(fixed);
  }
  const std::string text = ParameterText(WithParameters(parameters));
  EXPECT_THAT(text, HasSubstr("Not estimated: fixed0, fixed1,"));
  EXPECT_THAT(text, HasSubstr("... and 60 more in"));
  EXPECT_THAT(text, Not(HasSubstr("fixed99")));
}

/// The section in one line, of a result that was judged so.
std::string Judged(IntervalVerdict intervals, bool diagnosed) {
  Result result = WithParameters({Identified("theta2", Unit::kRadian, -5e-3, 6e-6)});
  result.intervals = intervals;
  if (diagnosed) {
    result.diagnosis.emplace();
    result.diagnosis->misfit.rows = 150;
  }
  std::string text = ParameterText(result);
  for (std::size_t at = 0; (at = text.find("\n  ", at)) != std::string::npos;) {
    text.replace(at, 3, " ");
  }
  return text;
}

TEST(ParameterSection, SaysForWhichParametersTheIntervalsHold) {
  const std::string text = Judged(IntervalVerdict::kHold, true);
  EXPECT_THAT(text, HasSubstr("They hold for the parameters called identified"));
  EXPECT_THAT(text, Not(HasSubstr("do not hold")));
}

TEST(ParameterSection, SaysWhyTheIntervalsDoNotHold) {
  const std::string noise = Judged(IntervalVerdict::kModelMissesNoise, true);
  EXPECT_THAT(noise,
              HasSubstr("The rigid model does not meet the noise, so the intervals do not hold"));
  EXPECT_THAT(noise, HasSubstr("has moved parameters, see UNMODELLED EFFECTS."));
  EXPECT_THAT(noise, Not(HasSubstr("They hold")));
  EXPECT_THAT(Judged(IntervalVerdict::kGeometryIncomplete, true),
              HasSubstr("is not complete, so the intervals do not hold"));
}

TEST(ParameterSection, RefersToNoSectionThatIsNotThere) {
  const std::string text = Judged(IntervalVerdict::kModelMissesNoise, false);
  EXPECT_THAT(text, HasSubstr("has moved parameters."));
  EXPECT_THAT(text, Not(HasSubstr("UNMODELLED EFFECTS")));
}

TEST(ParameterSection, IsEmptyWithoutAUsableFit) {
  EXPECT_TRUE(ParameterSection(DivergedResult()).empty());
}

}  // namespace
}  // namespace dhcal
