// Runs another program and waits for it.
#ifndef DHCAL_TOOLS_PROOF_RUN_PROGRAM_H_
#define DHCAL_TOOLS_PROOF_RUN_PROGRAM_H_

#include <filesystem>
#include <string>
#include <vector>

namespace dhcal {

/// Exit status of `program` with its arguments; what it prints goes to the file `log`. -1 when it
/// could not be started, 128 + signal when one ended it.
int RunProgram(const std::filesystem::path& program,
               const std::vector<std::string>& arguments,
               const std::filesystem::path& log);

/// Where the running program itself lies.
std::filesystem::path OwnProgram();

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_RUN_PROGRAM_H_
