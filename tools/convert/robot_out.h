// A robot as the text of any of the files that hold one.
#ifndef DHCAL_TOOLS_CONVERT_ROBOT_OUT_H_
#define DHCAL_TOOLS_CONVERT_ROBOT_OUT_H_

#include <optional>
#include <string>

#include "core/base/diagnostics.h"
#include "tools/convert/robot_in.h"
#include "tools/convert/run.h"

namespace dhcal {

/// The text for `options.to`: a kind by --kind, else by the name's ending. What the form cannot
/// hold is a note, and stands in the file where it has comments. Nothing after an error.
std::optional<std::string> AnyRobotText(const RobotIn& in,
                                        const ConvertOptions& options,
                                        Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CONVERT_ROBOT_OUT_H_
