// The sections of the report. Each is empty when it has nothing to say.
#ifndef DHCAL_CORE_REPORT_SECTIONS_H_
#define DHCAL_CORE_REPORT_SECTIONS_H_

#include <string>

#include "core/model/problem_spec.h"
#include "core/model/result.h"
#include "core/report/document.h"

namespace dhcal {

/// What was read and asked: robot, recording, rows, measurement, noise, solver.
Section InputSection(const ProblemSpec& spec, const Result& result);

/// Whether the files can belong together and what is odd about them; empty where nothing is.
Section SetupSection(const Result& result);

/// Rows that were found misread; empty without any.
Section SetAsideSection(const Result& result);

/// The answer: error of the prediction before and after, on fitted and on unseen rows.
Section OutcomeSection(const Result& result);

/// What the problem file's task may expect; empty where it names none.
Section TaskSection(const Result& result);

/// The same in one sentence; empty where there is nothing to say.
std::string TaskSentence(const Result& result);

/// Says that there are no parameters, and why not.
Section NoOutcomeSection(const Result& result);

/// How each solver ended, and its iterations.
Section SolverSection(const Result& result);

/// The estimated parameters of the model that is delivered.
Section ParameterSection(const Result& result);

/// What the readings cannot tell of the model that is delivered.
Section IdentifiabilitySection(const Result& result);

/// How well the poses determine the parameters, in indices, singular values and checks.
Section QualitySection(const Result& result);

/// Which places and drivers the residuals of the geometry point at.
Section MapSection(const Result& result);

/// Differences of the two solvers, those that no reading can see apart.
Section ComparisonSection(const Result& result);

/// Whether the fit holds on rows that it has not seen.
Section ValidationSection(const Result& result);

/// The rows that fit worst.
Section ResidualSection(const Result& result);

/// "UNMODELLED EFFECTS: PARTLY EXPLAINED".
std::string DiagnosisTitle(const DiagnosisResult& diagnosis);

/// What physics was left out, how sure that is, and what stays hidden.
Section DiagnosisSection(const ProblemSpec& spec, const Result& result);

/// What else a reader should know.
Section NotesSection(const Result& result);

/// "transmission_error.5" of a value of a curve, "transmission_error.5.at_-27"; else "". A curve is
/// told as one thing: its values mean nothing each by itself.
std::string CurveOf(const std::string& parameter);

/// "SVD Gauss-Newton", "Levenberg-Marquardt".
std::string SolverName(SolverMethod method);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_SECTIONS_H_
