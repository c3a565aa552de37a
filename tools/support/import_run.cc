#include "tools/support/import_run.h"

#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/import.h"
#include "tools/support/batch.h"

namespace dhcal {

int RunImport(const CommandLine& command_line) {
  Diagnostics diagnostics;
  std::optional<std::string> text;
  std::vector<JointRow> joints;
  bool good = true;
  if (!command_line.problems.empty()) {
    const std::optional<ProblemSpec> spec =
        ReadProblemFile(command_line.problems.front(), command_line.data_dir, &diagnostics);
    good = spec.has_value();
    if (spec) joints = spec->robot.joints;
  }
  if (good) text = ImportColumns(command_line.import, joints, &diagnostics);
  std::cerr << diagnostics.ToString();
  if (!text) return kExitBadInput;
  std::cout << *text;
  return kExitOk;
}

}  // namespace dhcal
