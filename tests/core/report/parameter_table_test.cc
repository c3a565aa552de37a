#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/sections.h"
#include "tests/core/io/example_result.h"

namespace dhcal {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// A result with one parameter of each kind in `parameters`.
Result WithParameters(std::vector<ParameterResult> parameters, double rms) {
  Result result = ExampleResult();
  result.fits[0].parameters = std::move(parameters);
  result.fits[0].rms = rms;
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
  const std::string text =
      ParameterSection(WithParameters({Identified("theta1", Unit::kRadian, 870e-6, 2e-16),
                                       Identified("theta5", Unit::kRadian, -806.99e-6, 3e-13),
                                       Identified("alpha5", Unit::kRadian, 463.89e-6, kNotSet),
                                       Identified("a5", Unit::kMetre, 62.98e-6, 3e-13),
                                       Identified("d2", Unit::kMetre, -68.81e-6, 3.1e-4)},
                                      2e-16));
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
      ParameterSection(WithParameters({Identified("theta1", Unit::kRadian, 0.87654e-3, 0.01234e-3),
                                       Identified("a1", Unit::kMetre, 0.98765e-3, 0.1234e-3)},
                                      2e-5));
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
  const std::string text = ParameterSection(WithParameters(parameters, 2e-5));
  EXPECT_THAT(text, HasSubstr("Held at their nominal values: fixed0, fixed1,"));
  EXPECT_THAT(text, HasSubstr("60 more in result.json"));
  EXPECT_THAT(text, Not(HasSubstr("fixed99")));
}

/// A result with one parameter and a diagnosis that came to this verdict.
Result Diagnosed(DiagnosisVerdict verdict, const std::string& effect_class) {
  Result result = WithParameters({Identified("theta2", Unit::kRadian, -5e-3, 6e-6)}, 4e-4);
  result.diagnosis.emplace();
  result.diagnosis->verdict = verdict;
  result.diagnosis->misfit.rows = 150;
  if (!effect_class.empty()) {
    result.diagnosis->findings.emplace_back();
    result.diagnosis->findings[0].effect_class = effect_class;
    result.diagnosis->findings[0].is_geometry = effect_class == "geometry";
  }
  return result;
}

/// The section in one line.
std::string Unwrapped(const Result& result) {
  std::string text = ParameterSection(result);
  for (std::size_t at = 0; (at = text.find("\n  ", at)) != std::string::npos;) {
    text.replace(at, 3, " ");
  }
  return text;
}

TEST(ParameterSection, IntervalsHoldWhereTheModelMeetsTheNoise) {
  for (const Result& result : {ExampleResult(), Diagnosed(DiagnosisVerdict::kConsistent, "")}) {
    const std::string text = Unwrapped(result);
    EXPECT_THAT(text, HasSubstr("They hold for the parameters called identified"));
    EXPECT_THAT(text, Not(HasSubstr("do not hold")));
  }
}

TEST(ParameterSection, IntervalsDoNotHoldWhereTheDiagnosisFoundPhysics) {
  for (const DiagnosisVerdict verdict : {DiagnosisVerdict::kExplained,
                                         DiagnosisVerdict::kPartlyExplained,
                                         DiagnosisVerdict::kAmbiguous,
                                         DiagnosisVerdict::kUnexplained}) {
    const std::string text = Unwrapped(Diagnosed(verdict, "C1"));
    EXPECT_THAT(text,
                HasSubstr("The rigid model does not meet the noise, so the intervals do not "
                          "hold"));
    EXPECT_THAT(text, HasSubstr("has moved parameters, see LEFT-OUT PHYSICS."));
    EXPECT_THAT(text, Not(HasSubstr("They hold")));
  }
}

TEST(ParameterSection, IntervalsDoNotHoldWhereGeometryIsMissing) {
  const std::string text = Unwrapped(Diagnosed(DiagnosisVerdict::kExplained, "geometry"));
  EXPECT_THAT(text, HasSubstr("is not complete, so the intervals do not hold"));
  EXPECT_THAT(text, HasSubstr("see LEFT-OUT PHYSICS."));
}

TEST(ParameterSection, IntervalsDoNotHoldWhereChiSquareIsFarAboveOne) {
  Result result = WithParameters({Identified("theta2", Unit::kRadian, -5e-3, 6e-6)}, 4e-4);
  result.fits[0].chi2_reduced = 152;
  result.fits[0].cost = 152 * 33 / 2.0;
  const std::string text = Unwrapped(result);
  EXPECT_THAT(text, HasSubstr("The rigid model does not meet the noise"));
  EXPECT_THAT(text, HasSubstr("has moved parameters."));
  EXPECT_THAT(text, Not(HasSubstr("LEFT-OUT PHYSICS"))) << "there is no such section";
}

TEST(ParameterSection, IntervalsHoldWhereFewReadingsMissByChance) {
  Result result = WithParameters({Identified("theta2", Unit::kRadian, -5e-3, 6e-6)}, 4e-4);
  result.fits[0].chi2_reduced = 1.8;
  result.fits[0].cost = 1.8 * 4 / 2;  // four degrees of freedom
  EXPECT_THAT(Unwrapped(result), HasSubstr("They hold for the parameters called identified"));
}

TEST(ParameterSection, IsEmptyWithoutAUsableFit) {
  EXPECT_EQ(ParameterSection(DivergedResult()), "");
}

}  // namespace
}  // namespace dhcal
