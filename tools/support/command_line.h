// The command line of ceres_dhcal.
#ifndef DHCAL_TOOLS_SUPPORT_COMMAND_LINE_H_
#define DHCAL_TOOLS_SUPPORT_COMMAND_LINE_H_

#include <optional>
#include <string>
#include <vector>

namespace dhcal {

struct CommandLine {
  std::vector<std::string> problems;  // in the order given
  std::string out;                    // folder, or the parent of folders for several problems
  std::string data_dir;               // flag, else environment variable DHCAL_DATA, else empty
  std::string diagnosis;
  std::string method;  // overrides the file when not empty
  std::string singular_value_tolerance;
  std::string import;            // a table whose columns are guessed, instead of a run
  std::optional<double> accept;  // [m] largest error on unseen rows
  bool quiet = false;
  bool verbose = false;
  bool try_fix = false;  // run on with the cure where the files are wrong
};

enum class CommandLineStatus {
  kRun,    // go on
  kDone,   // --help or --version was answered
  kError,  // told on stderr
};

/// Parses and removes flags. `--problem` may be given several times or as a comma-separated list;
/// plain arguments are problems too.
CommandLineStatus ParseCommandLine(int argc, char** argv, CommandLine* command_line);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_SUPPORT_COMMAND_LINE_H_
