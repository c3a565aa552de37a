// The sections of the text report. Each returns "" when it has nothing to say.
#ifndef DHCAL_CORE_REPORT_SECTIONS_H_
#define DHCAL_CORE_REPORT_SECTIONS_H_

#include <string>

#include "core/model/problem_spec.h"
#include "core/model/result.h"

namespace dhcal {

/// What was read and asked: robot, recording, rows, measurement, noise, solver.
std::string InputSection(const ProblemSpec& spec, const Result& result);

/// The answer: error of the prediction before and after, on fitted and on unseen rows.
std::string OutcomeSection(const Result& result);

/// Says that there are no parameters, and why not.
std::string NoOutcomeSection(const Result& result);

/// How each solver ended, and its iterations.
std::string SolverSection(const Result& result);

/// The estimated parameters of the best fit.
std::string ParameterSection(const Result& result);

/// What the readings of the best fit cannot tell.
std::string IdentifiabilitySection(const Result& result);

/// Differences of the two solvers, those that no reading can see apart.
std::string ComparisonSection(const Result& result);

/// Whether the fit holds on rows that it has not seen.
std::string ValidationSection(const Result& result);

/// The rows that fit worst.
std::string ResidualSection(const Result& result);

/// What physics was left out, how sure that is, and what stays hidden.
std::string DiagnosisSection(const ProblemSpec& spec, const Result& result);

/// What else a reader should know.
std::string NotesSection(const Result& result);

/// "SVD Gauss-Newton", "Levenberg-Marquardt".
std::string SolverName(SolverMethod method);

/// True when what is left is far below any instrument: the readings are a noise-free simulation,
/// and corrections are printed in micrometres and microradians as in the paper's Table III.
bool IsNoiseFree(const Result& result);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_SECTIONS_H_
