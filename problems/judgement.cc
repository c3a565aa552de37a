#include "problems/judgement.h"

#include <algorithm>
#include <vector>

#include "problems/noise.h"

namespace dhcal {
namespace {

// A reduced chi-square this large is no noise that was stated a little too small, ...
constexpr double kFarAboveNoise = 1.5;
constexpr double kNoChance = 1e-3;  // ... and, with few readings, this improbable no chance.

/// True if all that was left out is geometry, which the readings took into other parameters.
bool OnlyGeometryLeftOut(const DiagnosisResult& diagnosis) {
  const std::vector<Finding>& findings = diagnosis.findings;
  return diagnosis.verdict == DiagnosisVerdict::kExplained &&
         std::all_of(findings.begin(), findings.end(), [](const Finding& finding) {
           return finding.effect_class == "geometry";
         });
}

}  // namespace

bool IsNoiseFree(const Result& result) {
  return result.best() != nullptr && result.best()->rms < kFinestSigma;
}

IntervalVerdict JudgeIntervals(const Result& result) {
  if (result.diagnosis && result.diagnosis->answered()) {
    if (result.diagnosis->verdict == DiagnosisVerdict::kConsistent) return IntervalVerdict::kHold;
    return OnlyGeometryLeftOut(*result.diagnosis) ? IntervalVerdict::kGeometryIncomplete
                                                  : IntervalVerdict::kModelMissesNoise;
  }
  const FitResult* const fit = result.best();
  const bool missed =
      fit != nullptr && fit->chi2_reduced > kFarAboveNoise && fit->chi2_p < kNoChance;
  return missed ? IntervalVerdict::kModelMissesNoise : IntervalVerdict::kHold;
}

IntervalVerdict JudgeDelivered(const DiagnosisResult& d) {
  return d.verdict == DiagnosisVerdict::kExplained ? IntervalVerdict::kHold
                                                   : IntervalVerdict::kModelMissesNoise;
}

}  // namespace dhcal
