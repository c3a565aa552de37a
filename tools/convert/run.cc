#include "tools/convert/run.h"

#include <filesystem>
#include <optional>

#include "core/base/diagnostics.h"
#include "core/io/whole_file.h"
#include "tools/convert/robot_in.h"
#include "tools/convert/robot_out.h"

namespace dhcal {
namespace {

bool OptionsAreComplete(const ConvertOptions& options, Diagnostics* diagnostics) {
  if (options.from.empty()) diagnostics->Error({"--from"}, "is missing: the file to read");
  if (options.to.empty()) diagnostics->Error({"--to"}, "is missing: the file to write");
  const bool known = options.convention.empty() || options.convention == "standard" ||
                     options.convention == "modified";
  if (!known) {
    diagnostics->Error({"--convention"},
                       "is '" + options.convention + "', but standard or modified is expected");
  }
  std::error_code ignored;
  if (std::filesystem::equivalent(options.from, options.to, ignored) && !ignored) {
    diagnostics->Error({"--to"}, "is the file that is read; name another one");
  }
  return diagnostics->ok();
}

bool Convert(const ConvertOptions& options, Diagnostics* diagnostics) {
  if (!OptionsAreComplete(options, diagnostics)) return false;
  const std::optional<RobotIn> in = ReadAnyRobot(options, diagnostics);
  if (!in) return false;
  const std::optional<std::string> text = AnyRobotText(*in, options, diagnostics);
  return text && WriteWholeFile(options.to, *text, diagnostics);
}

}  // namespace

int RunConvert(const ConvertOptions& options, std::ostream& messages) {
  Diagnostics diagnostics;
  const bool done = Convert(options, &diagnostics);
  messages << diagnostics.ToString();
  return done ? kConvertOk : kConvertBadInput;
}

}  // namespace dhcal
