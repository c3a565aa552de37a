// Command lines of the programs beside ceres_dhcal: flags that each hold one text.
#ifndef DHCAL_TOOLS_SUPPORT_FLAGS_H_
#define DHCAL_TOOLS_SUPPORT_FLAGS_H_

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dhcal {

struct Flags {
  std::vector<std::pair<std::string, std::string*>> texts;  // "--name value", "--name=value"
  std::vector<std::pair<std::string, bool*>> switches;      // "--name"
  std::vector<std::string>* words = nullptr;                // what is no flag; none where null
};

/// Takes the flags off a command line; '-' within a name counts as '_'. Returns the argument that
/// is no flag (and no word, where there may be some) or lacks its value, "" where there is none.
std::string TakeFlags(int argc, char** argv, const Flags& flags);

struct FlagProgram {
  const char* name;
  const char* help;
  Flags flags;
  std::string* data_dir;     // a flag's, preset with the environment variable DHCAL_DATA
  std::function<int()> run;  // once the flags are taken; returns the exit status
};

/// main() of such a program. Exit status beside that of `run`: 0 after --help, 2 for a command line
/// that is wrong, 1 for a fault of the program.
int RunFlagProgram(int argc, char** argv, const FlagProgram& program);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_SUPPORT_FLAGS_H_
