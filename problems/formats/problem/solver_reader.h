// Reads the section `solver` of a problem file.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_SOLVER_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_SOLVER_READER_H_

#include <string_view>

#include "core/io/yaml_value.h"
#include "core/model/problem_spec.h"

namespace dhcal {

/// "noise", "paper" or a number above 0 and below 1, relative to the largest singular value.
/// Returns false, and changes nothing, for anything else.
bool ParseTruncation(std::string_view text, SolverSpec* solver);

/// "svd_gauss_newton", "levenberg_marquardt" or "both".
bool ParseSolverMethod(std::string_view text, SolverSpec* solver);

void ReadSolver(const YamlValue& value, SolverSpec* solver);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_SOLVER_READER_H_
