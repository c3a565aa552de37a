#include "problems/judgement.h"

#include <string>

#include <gtest/gtest.h>

#include "core/math/statistics.h"
#include "core/model/result.h"

namespace dhcal {
namespace {

/// A fit without a diagnosis.
Result FitThatLeaves(double rms) {
  Result result;
  result.fits.resize(1);
  result.fits[0].usable = true;
  result.fits[0].rms = rms;
  result.best_fit = 0;
  return result;
}

/// A fit whose whitened squares are `reduced` per degree of freedom.
Result WithChiSquare(double reduced, int freedom) {
  Result result = FitThatLeaves(4e-4);
  result.fits[0].chi2_reduced = reduced;
  result.fits[0].chi2_p = ChiSquareTail(reduced * freedom, freedom);
  return result;
}

/// A fit and a diagnosis that came to this verdict.
Result WithVerdict(DiagnosisVerdict verdict, const std::string& effect_class) {
  Result result = FitThatLeaves(4e-4);
  result.diagnosis.emplace();
  result.diagnosis->verdict = verdict;
  result.diagnosis->misfit.rows = 150;
  if (!effect_class.empty()) {
    result.diagnosis->findings.emplace_back();
    result.diagnosis->findings[0].effect_class = effect_class;
  }
  return result;
}

TEST(JudgeIntervals, TheyHoldWhereTheModelMeetsTheNoise) {
  EXPECT_EQ(JudgeIntervals(WithVerdict(DiagnosisVerdict::kConsistent, "")), IntervalVerdict::kHold);
  EXPECT_EQ(JudgeIntervals(WithChiSquare(1.04, 300)), IntervalVerdict::kHold);
  EXPECT_EQ(JudgeIntervals(FitThatLeaves(4e-4)), IntervalVerdict::kHold);
  EXPECT_EQ(JudgeIntervals(Result()), IntervalVerdict::kHold);
}

TEST(JudgeIntervals, TheyDoNotWhereTheDiagnosisFoundPhysics) {
  for (const DiagnosisVerdict verdict : {DiagnosisVerdict::kExplained,
                                         DiagnosisVerdict::kPartlyExplained,
                                         DiagnosisVerdict::kAmbiguous,
                                         DiagnosisVerdict::kUnexplained}) {
    EXPECT_EQ(JudgeIntervals(WithVerdict(verdict, "C1")), IntervalVerdict::kModelMissesNoise);
  }
}

TEST(JudgeIntervals, TheyDoNotWhereGeometryIsMissing) {
  EXPECT_EQ(JudgeIntervals(WithVerdict(DiagnosisVerdict::kExplained, "geometry")),
            IntervalVerdict::kGeometryIncomplete);
  Result both = WithVerdict(DiagnosisVerdict::kExplained, "geometry");
  both.diagnosis->findings.emplace_back();
  both.diagnosis->findings[1].effect_class = "C1";
  EXPECT_EQ(JudgeIntervals(both), IntervalVerdict::kModelMissesNoise);
}

TEST(JudgeIntervals, TheyDoNotWhereChiSquareIsFarAboveOne) {
  EXPECT_EQ(JudgeIntervals(WithChiSquare(152, 33)), IntervalVerdict::kModelMissesNoise);
  // Nor where the diagnosis gave up, which says nothing.
  Result gave_up = WithChiSquare(152, 33);
  gave_up.diagnosis.emplace();
  gave_up.diagnosis->verdict = DiagnosisVerdict::kUnexplained;
  EXPECT_EQ(JudgeIntervals(gave_up), IntervalVerdict::kModelMissesNoise);
  gave_up.fits[0].chi2_reduced = 1;
  gave_up.fits[0].chi2_p = 0.5;
  EXPECT_EQ(JudgeIntervals(gave_up), IntervalVerdict::kHold);
}

TEST(JudgeIntervals, TheyHoldWhereFewReadingsMissByChance) {
  EXPECT_EQ(JudgeIntervals(WithChiSquare(1.8, 4)), IntervalVerdict::kHold);
  EXPECT_EQ(JudgeIntervals(WithChiSquare(1.8, 400)), IntervalVerdict::kModelMissesNoise);
}

TEST(IsNoiseFree, MeansLessThanAnyInstrumentReads) {
  EXPECT_TRUE(IsNoiseFree(FitThatLeaves(2e-16)));
  EXPECT_FALSE(IsNoiseFree(FitThatLeaves(2e-5)));
  EXPECT_FALSE(IsNoiseFree(Result()));
}

}  // namespace
}  // namespace dhcal
