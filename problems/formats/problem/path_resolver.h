// How paths in a problem file become paths that can be opened.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_PATH_RESOLVER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_PATH_RESOLVER_H_

#include <functional>
#include <string>

#include "core/io/yaml_value.h"

namespace dhcal {

/// Turns a path as the file writes it into one that can be opened; "" after an error.
using PathResolver = std::function<std::string(const YamlValue&)>;

/// Relative to the file that the value stands in, "~/" as a shell has it; `data_dir` stands for a
/// leading "${DHCAL_DATA}".
std::string ResolvePath(const YamlValue& value, const std::string& data_dir);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_PATH_RESOLVER_H_
