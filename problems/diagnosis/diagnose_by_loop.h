// The diagnosis by the loop: rows, search, joint fit and outliers in rounds, then judgement.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_DIAGNOSE_BY_LOOP_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_DIAGNOSE_BY_LOOP_H_

#include "core/model/diagnosis.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"
#include "problems/fit.h"

namespace dhcal {

/// Decides everything in one loop (loop.h) and judges the outcome: findings, alternatives, what is
/// left, what is hidden. The inputs have been checked; `identified` is the fit that the problem
/// file asks for.
DiagnosisResult DiagnoseByLoop(const ProblemSpec& spec,
                               const Recording& recorded,
                               const Result& identified,
                               const Progress& progress);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_DIAGNOSE_BY_LOOP_H_
