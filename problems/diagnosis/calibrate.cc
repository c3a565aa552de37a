#include "problems/diagnosis/calibrate.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "problems/diagnosis/deliver.h"
#include "problems/diagnosis/diagnose.h"
#include "problems/diagnosis/remarks.h"
#include "problems/diagnosis/rows/oddities.h"
#include "problems/identify.h"
#include "problems/judgement.h"
#include "problems/setup/plausibility.h"

namespace dhcal {
namespace {

Recording WithSetAside(const Recording& recording, const std::vector<int>& rows) {
  Recording marked = recording;
  marked.set_aside.assign(static_cast<std::size_t>(recording.num_rows()), false);
  for (const int row : rows) marked.set_aside[static_cast<std::size_t>(row)] = true;
  return marked;
}

/// The problem's own fit once more, without the rows that the diagnosis found misread.
void FitAgain(const ProblemSpec& spec,
              const Recording& marked,
              const Progress& progress,
              Result* result) {
  Result again = IdentifyGeometry(spec, marked, progress);
  if (again.best() == nullptr) return;
  again.setup = std::move(result->setup);
  again.diagnosis = std::move(result->diagnosis);
  *result = std::move(again);
}

void Widen(double times, ParameterResult* p) {
  p->sigma *= times;
  p->ci95_low = p->value + times * (p->ci95_low - p->value);
  p->ci95_high = p->value + times * (p->ci95_high - p->value);
}

void Widen(double times, RegionError* error) {
  error->low = std::max(0.0, error->rms + times * (error->low - error->rms));
  error->high = error->rms + times * (error->high - error->rms);
}

/// What the parameters' sigmas make of a region.
void Widen(double times, TaskError* task) {
  Widen(times, &task->before);
  for (double* const error :
       {&task->after.rms, &task->after.low, &task->after.high, &task->after_largest}) {
    *error *= times;
  }
}

/// Remarks on the rows, and the sigmas that these allow.
void Finish(const ProblemSpec& spec, const Recording& recording, Result* result) {
  const Widening widening = WideningOf(recording, *result);
  for (std::string& remark : Remarks(spec, recording, *result, widening)) {
    result->notes.push_back(std::move(remark));
  }
  for (FitResult& fit : result->fits) {
    for (ParameterResult& p : fit.parameters) Widen(widening.all(), &p);
  }
  if (result->delivered) {
    for (ParameterResult& p : result->delivered->fit.parameters) Widen(widening.all(), &p);
  }
  if (result->task) Widen(widening.all(), &*result->task);
}

/// What is worth keeping if the diagnosis does not come to its end.
Result GeometryAlone(const ProblemSpec& spec, const Recording& recording, Result result) {
  result.notes.emplace_back(
      "The search for left-out physics had not ended when this was written: nothing is known of "
      "it. Run the program to its end, or with --diagnosis never.");
  Finish(spec, recording, &result);
  return result;
}

Result WithDiagnosis(const ProblemSpec& spec,
                     const Recording& recording,
                     const Watch& watch,
                     std::optional<CuredFiles>* cured) {
  Result result = IdentifyGeometry(spec, recording, watch.progress);
  SetupJudgement judgement = JudgeSetup(spec, recording, result);
  result.setup = std::move(judgement.setup);
  if (!result.setup.plausible) {
    if (cured != nullptr) *cured = std::move(judgement.cured);
    Refuse(&result);
    return result;
  }
  if (!WantsDiagnosis(spec, result)) return result;
  if (watch.geometry && result.best() != nullptr) {
    watch.geometry(GeometryAlone(spec, recording, result));
  }
  result.diagnosis = Guarded([&] { return Diagnose(spec, recording, result, watch.progress); });
  const std::vector<int> rows = result.diagnosis->misfit.outlier_rows;
  const Recording marked = rows.empty() ? Recording() : WithSetAside(recording, rows);
  const Recording& used = rows.empty() ? recording : marked;
  if (!rows.empty()) FitAgain(spec, used, watch.progress, &result);
  try {
    Deliver(spec, used, watch.progress, &result);
  } catch (const std::exception& error) {
    result.delivered.reset();
    result.notes.push_back(fmt::format(
        "Fitting geometry and effects together broke down ({}); calibrated.yaml holds the rigid "
        "robot.",
        error.what()));
  }
  result.rows_set_aside = DescribeSetAside(recording, rows, &result.residuals);
  result.intervals = JudgeIntervals(result);
  return result;
}

}  // namespace

Result Calibrate(const ProblemSpec& spec,
                 const Recording& recording,
                 const Watch& watch,
                 std::optional<CuredFiles>* cured) {
  Result result = WithDiagnosis(spec, recording, watch, cured);
  if (result.setup.plausible) Finish(spec, recording, &result);
  return result;
}

}  // namespace dhcal
