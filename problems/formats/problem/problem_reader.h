// Reads a problem file (YAML). Every key is checked; all errors are collected.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_PROBLEM_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_PROBLEM_READER_H_

#include <optional>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"

namespace dhcal {

/// Returns the problem, or nothing when `diagnostics` received an error. Paths in the file are
/// resolved against its folder; `data_dir`, when not empty, replaces a leading "${DHCAL_DATA}".
std::optional<ProblemSpec> ReadProblemFile(const std::string& file,
                                           const std::string& data_dir,
                                           Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_PROBLEM_READER_H_
