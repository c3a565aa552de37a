// What is odd about the input, though it can be used: told before the result.
#ifndef DHCAL_PROBLEMS_SETUP_LINT_H_
#define DHCAL_PROBLEMS_SETUP_LINT_H_

#include <string>
#include <vector>

#include "core/model/problem_spec.h"
#include "core/model/recording.h"

namespace dhcal {

/// A sentence each: joints that move little or not at all, poses that are few, times that no clock
/// shows, twists that look like radians, gravity beside a base that is tilted.
std::vector<std::string> Lint(const ProblemSpec& spec, const Recording& recording);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_LINT_H_
