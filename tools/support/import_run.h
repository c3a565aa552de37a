// The command `ceres_dhcal --import FILE`.
#ifndef DHCAL_TOOLS_SUPPORT_IMPORT_RUN_H_
#define DHCAL_TOOLS_SUPPORT_IMPORT_RUN_H_

#include "tools/support/command_line.h"

namespace dhcal {

/// Prints which columns the table probably has, as YAML for the problem file; messages to stderr.
/// The robot is that of the problem file, if one is given. Returns the exit status.
int RunImport(const CommandLine& command_line);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_SUPPORT_IMPORT_RUN_H_
