// The command `ceres_dhcal init`.
#ifndef DHCAL_TOOLS_SUPPORT_INIT_RUN_H_
#define DHCAL_TOOLS_SUPPORT_INIT_RUN_H_

#include <string>
#include <vector>

namespace dhcal {

/// `arguments` are those behind the word init. Writes a problem file to edit from the template of a
/// robot, never over another file, or prints the templates (--list). Returns the exit status.
int RunInit(const std::vector<std::string>& arguments);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_SUPPORT_INIT_RUN_H_
