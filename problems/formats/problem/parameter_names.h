// The names that a problem file may use for unknowns: groups ("theta", "tool"), single ones
// ("theta1", "base_rx"), and single ones of one run or target ("tool_z.A").
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_PARAMETER_NAMES_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_PARAMETER_NAMES_H_

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/robot.h"

namespace dhcal {

/// What a name stands for: `base` and `tool` hold lengths and angles.
enum class NameKind { kAngle, kLength, kLengthsAndAngles };

/// The kind of a group or parameter of this robot. Otherwise nothing, and `problem` says why,
/// to be read after the name: "is no parameter; did you mean 'theta1'?".
std::optional<NameKind> ClassifyParameterName(const std::string& name,
                                              const RobotModel& robot,
                                              std::string* problem);

/// "tool_z.A" -> "tool_z" and "A"; the second is "" without a dot.
std::pair<std::string, std::string> SplitOwner(const std::string& name);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_PARAMETER_NAMES_H_
