#include "tools/camera/settings.h"

#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/base/text.h"

namespace dhcal {
namespace {

class FlagReader {
 public:
  explicit FlagReader(Diagnostics* diagnostics) : diagnostics_(diagnostics) {}

  double Number(const char* flag, const std::string& text, double low, double high) {
    const std::optional<double> number = ParseDouble(text);
    if (number && *number >= low && *number <= high) return *number;
    Wrong(flag, text, fmt::format("a number of {} to {}", low, high));
    return low;
  }
  int Whole(const char* flag, const std::string& text, int low, int high) {
    const auto number = ParseInteger(text);
    if (number && *number >= low && *number <= high) return static_cast<int>(*number);
    Wrong(flag, text, fmt::format("a whole number of {} to {}", low, high));
    return low;
  }
  void Wrong(const char* flag, const std::string& text, const std::string& expected) {
    Error(fmt::format("--{} is '{}', but {} is expected", flag, Printable(text), expected));
  }
  void Error(const std::string& what) { diagnostics_->Error({"command line"}, what); }

 private:
  Diagnostics* diagnostics_;
};

void ReadView(const RulerCommand& command, FlagReader* flags, RulerOptions* ruler) {
  const std::string& way = command.direction;
  if (way != "right" && way != "left" && way != "down" && way != "up") {
    flags->Wrong("direction", way, "right, left, down or up");
  }
  if (command.rulings != "dark" && command.rulings != "light") {
    flags->Wrong("rulings", command.rulings, "dark or light");
  }
  ruler->view.along_columns = way == "down" || way == "up";
  ruler->backwards = way == "left" || way == "up";
  ruler->view.dark = command.rulings == "dark";
  ruler->longest_gap = flags->Whole("longest_gap", command.longest_gap, 0, 20);
}

void ReadLengths(const RulerCommand& command, FlagReader* flags, RulerSettings* settings) {
  if (command.pitch.empty()) {
    flags->Error("--pitch_mm is missing; give the distance between two rulings");
    return;
  }
  settings->pitch = flags->Number("pitch_mm", command.pitch, 0.001, 1000);
  settings->coarse_error = settings->pitch / 4;
  if (!command.coarse_error.empty()) {
    settings->coarse_error =
        flags->Number("coarse_error_mm", command.coarse_error, 0, 0.45 * settings->pitch);
  }
  if (!command.step.empty()) settings->step = flags->Number("step_mm", command.step, -1e4, 1e4);
}

}  // namespace

RulerSettings ReadSettings(const RulerCommand& command, Diagnostics* diagnostics) {
  FlagReader flags(diagnostics);
  RulerSettings settings;
  if (command.images.empty()) flags.Error("no images are given; name at least one");
  ReadView(command, &flags, &settings.ruler);
  settings.threads = flags.Whole("threads", command.threads, 1, 256);
  if (command.calibrate.empty()) {
    ReadLengths(command, &flags, &settings);
    const bool coarse =
        !command.step.empty() || !command.coarse.empty() || !command.readings.empty();
    if (command.images.size() > 1 && !coarse) {
      flags.Error(
          "nothing says how many rulings lie between the images: give where the camera roughly "
          "is in a column coarse_mm of --readings or --coarse, or its steps with --step_mm");
    }
  } else if (!command.readings.empty() || !command.out.empty() || !command.lens.empty()) {
    flags.Error(
        "--calibrate_lens makes the file of a lens and nothing else; remove --readings, --out "
        "and --lens");
  }
  return settings;
}

}  // namespace dhcal
