// Loads a problem case and runs it, as the program does.
#ifndef DHCAL_TESTS_SUPPORT_PROBLEM_CASES_H_
#define DHCAL_TESTS_SUPPORT_PROBLEM_CASES_H_

#include <map>
#include <string>

#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"

namespace dhcal {

/// The problem of problems/cases/<name>.yaml; the test fails on any input error.
ProblemSpec LoadCase(const std::string& name);

/// The problem of any file.
ProblemSpec LoadProblem(const std::string& file);

/// Its recording, simulated or read.
Recording RecordingOf(const ProblemSpec& spec);

/// IdentifyGeometry on them.
Result RunCase(const ProblemSpec& spec);

/// IdentifyGeometry and Diagnose, whatever the problem says of the diagnosis.
DiagnosisResult Diagnosed(const ProblemSpec& spec, const Recording& recording);

/// Parameters of a fit by name.
std::map<std::string, ParameterResult> ByName(const FitResult& fit);

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_PROBLEM_CASES_H_
