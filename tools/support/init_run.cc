#include "tools/support/init_run.h"

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/base/diagnostics.h"
#include "core/base/text.h"
#include "core/io/text_file.h"
#include "core/io/whole_file.h"
#include "problems/formats/problem/problem_reader.h"
#include "tools/support/batch.h"
#include "tools/support/robot_templates.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;

constexpr char kInitUsage[] = "ceres_dhcal init NAME [--out FOLDER], or ceres_dhcal init --list";
constexpr char kFileName[] = "problem.yaml";

struct InitOptions {
  std::string name;
  std::string out = ".";
  bool list = false;
};

int RefuseInit(const std::string& why) {
  std::cerr << "ceres_dhcal: error: " << why << "\n";
  return kExitBadInput;
}

/// Nothing where they cannot be understood; `*wrong` then says why.
std::optional<InitOptions> ParseInit(const std::vector<std::string>& arguments,
                                     std::string* wrong) {
  InitOptions options;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string& argument = arguments[k];
    if (argument == "--list") {
      options.list = true;
    } else if (StartsWith(argument, "--out=")) {
      options.out = argument.substr(6);
    } else if (argument == "--out" && k + 1 < arguments.size()) {
      options.out = arguments[++k];
    } else if (StartsWith(argument, "-")) {
      *wrong = "init does not know '" + argument + "', or it lacks its value";
      return std::nullopt;
    } else if (!options.name.empty()) {
      *wrong = "init takes one robot, not '" + options.name + "' and '" + argument + "'";
      return std::nullopt;
    } else {
      options.name = argument;
    }
  }
  if (options.out.empty()) *wrong = "--out needs a folder";
  if (!options.list && options.name.empty()) *wrong = "init needs the name of a robot";
  if (!wrong->empty()) return std::nullopt;
  return options;
}

int ListTemplates(const std::string& folder) {
  Diagnostics diagnostics;
  for (const std::string& name : RobotTemplateNames(folder)) {
    const std::optional<ProblemSpec> spec =
        ReadProblemFile(RobotTemplateFile(folder, name), "", &diagnostics);
    if (spec) std::cout << fmt::format("{:<20} {}\n", name, spec->robot.name);
  }
  std::cerr << diagnostics.ToString();
  return diagnostics.ok() ? kExitOk : kExitBadInput;
}

std::string NoSuchTemplate(const std::string& folder, const std::string& name) {
  const std::string nearest = NearestName(name, RobotTemplateNames(folder));
  return "there is no template '" + name + "'" +
         (nearest.empty() ? "." : "; did you mean '" + nearest + "'?") +
         " All of them: ceres_dhcal init --list. A robot without one: copy the nearest and write "
         "its data sheet's rows";
}

int WriteTemplate(const std::string& source, const std::string& folder) {
  const fs::path file = (fs::path(folder) / kFileName).lexically_normal();
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error))) {
    return RefuseInit(file.string() +
                      " is there already and stays as it is; say --out FOLDER, or remove it");
  }
  Diagnostics diagnostics;
  const std::optional<std::string> text = ReadTextFile(source, &diagnostics);
  fs::create_directories(folder, error);
  if (error) {
    diagnostics.Error({folder, 0, 0}, "the folder cannot be made: " + error.message());
  } else if (text) {
    WriteWholeFile(file.string(), *text, &diagnostics);
  }
  std::cerr << diagnostics.ToString();
  if (!diagnostics.ok()) return kExitBadInput;
  std::cout << fmt::format(
      "{0} is written. Its head says where the numbers come from and what to check.\n"
      "Edit the lines marked TO DO, then: ceres_dhcal --problem {0}\n",
      file.string());
  return kExitOk;
}

}  // namespace

int RunInit(const std::vector<std::string>& arguments) {
  std::string wrong;
  const std::optional<InitOptions> options = ParseInit(arguments, &wrong);
  if (!options) return RefuseInit(wrong + "; usage: " + kInitUsage);
  const std::string folder = RobotTemplatesFolder();
  if (folder.empty()) {
    return RefuseInit(
        "the templates of robots are not there: neither share/ceres_dhcal/robots beside the "
        "program's bin/ nor problems/robots of its sources; install them again");
  }
  if (options->list) return ListTemplates(folder);
  const std::string source = RobotTemplateFile(folder, options->name);
  std::error_code error;
  const bool is_name = options->name.find('/') == std::string::npos;
  if (!is_name || !fs::is_regular_file(source, error)) {
    return RefuseInit(NoSuchTemplate(folder, options->name));
  }
  return WriteTemplate(source, options->out);
}

}  // namespace dhcal
