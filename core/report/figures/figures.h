// The figures of the report. Each is empty where there is nothing to show. Where a recording has
// more rows than an eye can tell apart, every n-th is drawn and the caption says so; residuals.csv
// has them all.
#ifndef DHCAL_CORE_REPORT_FIGURES_FIGURES_H_
#define DHCAL_CORE_REPORT_FIGURES_FIGURES_H_

#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"
#include "core/report/document.h"

namespace dhcal {

/// How large the errors are before and after: shares of the rows, and their running sum.
Figure ErrorFigure(const Result& result);

/// Errors as arrows where they were measured, seen along three axes, before and after.
Figure ArrowFigure(const ProblemSpec& spec, const Recording& recording, const Result& result);

/// Errors over the number of the row.
Figure RowFigure(const Result& result);

/// What is left, over each joint and over whatever else was recorded.
Figure DriverFigure(const ProblemSpec& spec, const Recording& recording, const Result& result);

/// Which joint angles were visited.
Figure RangeFigure(const ProblemSpec& spec, const Recording& recording);

/// Corrections of the robot's numbers with their 95 % intervals.
Figure CorrectionFigure(const Result& result);

/// Errors of the joints that have effects, over their angle, with what the model says of them.
Figure JointErrorFigure(const ProblemSpec& spec, const Result& result);

/// Periodic parts of the same errors by their order.
Figure OrderFigure(const ProblemSpec& spec, const Result& result);

/// Which places and drivers the residuals of the geometry point at.
Figure MapFigure(const DiagnosisResult& diagnosis);

/// How much speaks for each finding, and what could stand in its place.
Figure EvidenceFigure(const DiagnosisResult& diagnosis);

/// What effects too small to be seen could do elsewhere.
Figure HiddenFigure(const DiagnosisResult& diagnosis);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_FIGURES_FIGURES_H_
