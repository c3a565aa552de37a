#include <exception>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "problems/diagnosis/diagnose.h"
#include "problems/diagnosis/held_fit.h"
#include "problems/noise.h"

namespace dhcal {

bool WantsDiagnosis(const ProblemSpec& spec, const Result& identified) {
  if (spec.diagnosis.run == DiagnosisRun::kNever) return false;
  if (spec.diagnosis.run == DiagnosisRun::kAlways) return true;
  // No answer, or one that no manufacture explains, is itself a reason to ask what is wrong.
  if (identified.best() == nullptr) return true;
  if (!RowsPlausible(spec.robot, identified.calibrated)) return true;
  const bool noise_free = spec.simulate && spec.simulate->noise <= kFinestSigma;
  return !noise_free && identified.best()->rms > kFinestSigma;
}

DiagnosisResult Guarded(const std::function<DiagnosisResult()>& diagnose) {
  std::string fault = "an unknown error";
  try {
    return diagnose();
  } catch (const std::exception& error) {
    fault = error.what();
  } catch (...) {
  }
  DiagnosisResult d;
  d.verdict = DiagnosisVerdict::kFailed;
  d.summary = fmt::format(
      "the diagnosis broke down ({}), so nothing is known of left-out physics. The calibration was "
      "made before and does not depend on it",
      fault);
  return d;
}

}  // namespace dhcal
