#include "tools/support/command_line.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>

#include <gflags/gflags.h>

#include "core/base/text.h"
#include "core/report/effect_list.h"
#include "tools/support/acceptance.h"

DEFINE_string(out, "", "result folder, default <problem name>_result");
DEFINE_string(data_dir, "", "what ${DHCAL_DATA} in a problem file stands for");
DEFINE_string(method, "", "overrides solver.method of the file");
DEFINE_string(singular_value_tolerance, "", "overrides solver.singular_value_tolerance");
DEFINE_string(diagnosis, "", "overrides diagnosis.run of the file");
DEFINE_string(accept, "", "largest error on unseen rows that is accepted");
DEFINE_string(import, "", "a table whose columns are guessed");
DEFINE_bool(quiet, false, "print nothing but errors");
DEFINE_bool(verbose, false, "print the whole report");
DEFINE_bool(try_fix, false, "run on with the cure where the files are wrong");

namespace dhcal {
namespace {

constexpr char kHelp[] =
    R"(ceres_dhcal: finds the real Denavit-Hartenberg parameters of a serial robot.

  ceres_dhcal --problem FILE.yaml [--problem ...] [options]
  ceres_dhcal init NAME [--out FOLDER]     writes FOLDER/problem.yaml of a common robot, to edit
  ceres_dhcal init --list                  prints the robots that there are

  --problem FILE    problem file; repeat the flag for several, which gives a summary table
  --out DIR         result folder (default <problem name>_result); with several problems the
                    folder that holds theirs
  --data_dir DIR    what ${DHCAL_DATA} in a problem file stands for (default: the environment
                    variable DHCAL_DATA)
  --method M        svd_gauss_newton | levenberg_marquardt | both, instead of the file's
  --singular_value_tolerance T
                    noise | paper | a number, instead of the file's
  --diagnosis D     auto | always | never: look for left-out physics, instead of the file's
  --accept LENGTH   0.1mm or 100um: end with exit status 3 where the error on rows that were not
                    fitted (RMS; of points 3-D), the one that the first screen announces, is larger
                    or no row was kept unseen
  --try_fix         where the files cannot belong together and one cure is certain, run on as if
                    they had been corrected; the files themselves stay as they are
  --import FILE     print which columns a recording probably has, as lines for the problem file to
                    correct; with --problem for the joints of that robot
  --list_effects    print the library of physical effects
  --verbose         print the whole report (report.txt) instead of its first screen
  --quiet           print nothing but errors
  --version, --help

Example:  ceres_dhcal --problem problems/cases/kr15.yaml

Flags may be written with - or _ between words.

Exit status: 0 a usable result, 1 no usable or plausible result (the report says why), 2 bad input,
3 a usable result that --accept does not accept.
)";

void AddProblems(const std::string& list, std::vector<std::string>* problems) {
  // A comma may be part of a file's name.
  if (std::filesystem::exists(list)) {
    problems->push_back(list);
    return;
  }
  std::stringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');) {
    if (!item.empty()) problems->push_back(item);
  }
}

/// "--name=value" or "--name value"; a switch needs no value. Advances *k over what it takes.
class Argument {
 public:
  Argument(int argc, char** argv, int* k) : argc_(argc), argv_(argv), k_(k) {
    const std::string text = argv[*k];
    is_flag_ = text.size() > 1 && text[0] == '-';
    if (!is_flag_) return;
    const std::size_t start = text.find_first_not_of('-');
    if (start == std::string::npos) return;
    const std::size_t equals = text.find('=');
    name_ = text.substr(start, equals == std::string::npos ? equals : equals - start);
    std::replace(name_.begin(), name_.end(), '-', '_');
    if (equals != std::string::npos) value_ = text.substr(equals + 1);
  }

  bool is_flag() const { return is_flag_; }
  const std::string& name() const { return name_; }
  /// The value, taking the next argument when there is none yet; nothing at the end of the line.
  std::optional<std::string> Value() {
    if (!value_ && *k_ + 1 < argc_) value_ = argv_[++*k_];
    return value_;
  }
  const std::optional<std::string>& own_value() const { return value_; }

 private:
  int argc_;
  char** argv_;
  int* k_;
  bool is_flag_ = false;
  std::string name_;
  std::optional<std::string> value_;
};

/// Switches, on by themselves and off with "no" before them.
const std::set<std::string>& Switches() {
  static const std::set<std::string> names = {"quiet", "try_fix", "verbose"};
  return names;
}

/// Flags that take a text.
const std::set<std::string>& Texts() {
  static const std::set<std::string> names = {
      "out", "data_dir", "method", "singular_value_tolerance", "diagnosis", "import", "accept"};
  return names;
}

std::string UnknownFlag(const std::string& name) {
  std::vector<std::string> known = {"problem", "help", "version", "list_effects"};
  known.insert(known.end(), Switches().begin(), Switches().end());
  known.insert(known.end(), Texts().begin(), Texts().end());
  const std::string nearest = NearestName(name, known);
  return "unknown flag '--" + name + "'" +
         (nearest.empty() ? "" : "; did you mean '--" + nearest + "'?");
}

/// Sets one of our flags; an error text when that cannot be done.
std::string SetFlag(Argument* argument) {
  const std::string& name = argument->name();
  const bool negated = name.rfind("no", 0) == 0 && Switches().count(name.substr(2)) > 0;
  if (negated || Switches().count(name) > 0) {
    const std::string value = argument->own_value().value_or(negated ? "false" : "true");
    const std::string flag = negated ? name.substr(2) : name;
    if (gflags::SetCommandLineOption(flag.c_str(), value.c_str()).empty()) {
      return "'--" + name + "=" + value + "' is not true or false";
    }
    return "";
  }
  if (Texts().count(name) == 0) return UnknownFlag(name);
  const std::optional<std::string> value = argument->Value();
  if (!value || value->empty()) return "flag '--" + name + "' needs a value";
  gflags::SetCommandLineOption(name.c_str(), value->c_str());
  return "";
}

CommandLineStatus Refuse(const std::string& why) {
  std::cerr << "ceres_dhcal: error: " << why << "; see ceres_dhcal --help\n";
  return CommandLineStatus::kError;
}

}  // namespace

CommandLineStatus ParseCommandLine(int argc, char** argv, CommandLine* command_line) {
  for (int k = 1; k < argc; ++k) {
    Argument argument(argc, argv, &k);
    if (!argument.is_flag()) {
      AddProblems(argv[k], &command_line->problems);
    } else if (argument.name() == "help" || argument.name() == "h") {
      std::cout << kHelp;
      return CommandLineStatus::kDone;
    } else if (argument.name() == "version") {
      std::cout << "ceres_dhcal " << DHCAL_VERSION << "\n";
      return CommandLineStatus::kDone;
    } else if (argument.name() == "list_effects") {
      std::cout << EffectList();
      return CommandLineStatus::kDone;
    } else if (argument.name() == "problem") {
      const std::optional<std::string> value = argument.Value();
      if (!value || value->empty()) return Refuse("flag '--problem' needs a file");
      AddProblems(*value, &command_line->problems);
    } else if (const std::string error = SetFlag(&argument); !error.empty()) {
      return Refuse(error);
    }
  }
  command_line->import = FLAGS_import;
  if (!FLAGS_accept.empty()) {
    command_line->accept = ParseLimit(FLAGS_accept);
    if (!command_line->accept) {
      return Refuse("--accept " + FLAGS_accept +
                    ": expected a length above 0 with its unit, 0.1mm or 100um");
    }
  }
  if (command_line->problems.empty() && command_line->import.empty()) {
    return Refuse("no problem given; say --problem FILE.yaml");
  }
  command_line->out = FLAGS_out;
  command_line->data_dir = FLAGS_data_dir;
  if (command_line->data_dir.empty()) {
    const char* const from_environment = std::getenv("DHCAL_DATA");
    if (from_environment != nullptr) command_line->data_dir = from_environment;
  }
  command_line->diagnosis = FLAGS_diagnosis;
  command_line->method = FLAGS_method;
  command_line->singular_value_tolerance = FLAGS_singular_value_tolerance;
  command_line->quiet = FLAGS_quiet;
  command_line->try_fix = FLAGS_try_fix;
  command_line->verbose = FLAGS_verbose;
  return CommandLineStatus::kRun;
}

}  // namespace dhcal
