// The task: where a robot's readings differ from its rigid model, say what physics was left out.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_DIAGNOSE_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_DIAGNOSE_H_

#include <functional>

#include "core/model/diagnosis.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"
#include "problems/fit.h"

namespace dhcal {

/// True if the problem file's `diagnosis.run` asks for one. With `auto`, recordings without noise
/// (simulations for comparing solvers) are not diagnosed: there is nothing to measure a misfit by,
/// unless the corrections found are beyond what manufacture explains, or the fit failed.
bool WantsDiagnosis(const ProblemSpec& spec, const Result& identified);

/// Rows, model, noise and names decided in rounds, then judged (PHYSICS.md M2). The
/// inputs have been checked; `identified` is the fit that the problem file asks for.
DiagnosisResult Diagnose(const ProblemSpec& spec,
                         const Recording& recording,
                         const Result& identified,
                         const Progress& progress);

/// What `diagnose` returns; where it throws, a diagnosis of verdict kFailed that says why. The
/// calibration is there already, and no fault of what comes after it may lose it.
DiagnosisResult Guarded(const std::function<DiagnosisResult()>& diagnose);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_DIAGNOSE_H_
