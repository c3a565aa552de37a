#include "tools/camera/settings.h"

#include <string>

#include "core/base/flag_values.h"

namespace dhcal {
namespace {

void ReadView(const RulerCommand& command, FlagValues* flags, RulerOptions* ruler) {
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
  flags->Whole("longest_gap", command.longest_gap, 0, 20, &ruler->longest_gap);
}

void ReadLengths(const RulerCommand& command, FlagValues* flags, RulerSettings* settings) {
  if (command.pitch.empty()) {
    flags->Error("--pitch_mm is missing; give the distance between two rulings");
    return;
  }
  if (!flags->Number("pitch_mm", command.pitch, 0.001, 1000, &settings->pitch)) return;
  settings->coarse_error = settings->pitch / 4;
  flags->Number(
      "coarse_error_mm", command.coarse_error, 0, 0.45 * settings->pitch, &settings->coarse_error);
  flags->Number("step_mm", command.step, -1e4, 1e4, &settings->step);
}

}  // namespace

RulerSettings ReadSettings(const RulerCommand& command, Diagnostics* diagnostics) {
  FlagValues flags(diagnostics);
  RulerSettings settings;
  if (command.images.empty()) flags.Error("no images are given; name at least one");
  ReadView(command, &flags, &settings.ruler);
  flags.Whole("threads", command.threads, 1, 256, &settings.threads);
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
