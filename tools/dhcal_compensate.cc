// dhcal_compensate: joint commands at which the real robot holds its tool where it is wanted.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "core/base/quiet_log.h"
#include "tools/compensate/run.h"

namespace dhcal {
namespace {

constexpr char kHelp[] =
    R"(dhcal_compensate: joint commands for the real robot, as a calibration describes it.

  dhcal_compensate --model calibrated.yaml --poses wanted.csv [options]

  --model FILE      calibrated.yaml of a result: geometry and effects with their values
  --poses FILE      wanted poses: x_mm y_mm z_mm and an orientation (qw qx qy qz, roll_deg pitch_deg
                    yaw_deg, or another form that recordings may have); joint coordinates q1_deg ...
                    beside them say on which branch the arm is. Payloads (payload_kg), approach
                    directions (dir1 ...), runs and targets as in recordings
  --nominal FILE    the problem file that was calibrated: the table has the nominal robot's joint
                    coordinates instead of poses, and the tool is wanted where that robot believes
                    it is
  --predict         evaluate only: where the real robot's tool is at the table's joint coordinates
  --frame F         base (default: of the file's robot.base) or world (the measurement frame)
  --seed_deg LIST   joint coordinates near the first pose (deg; of slides mm): 0,-90,90,0,30,0;
                    each further pose is sought from the one before
  --result FILE     result.json for the expected errors; default: beside the model
  --out FILE        default: the terminal
  --data_dir DIR    what ${DHCAL_DATA} in a problem file stands for (default: the environment
                    variable)

Output: one row per pose: commands, what the model leaves at them (position_error_nm,
rotation_error_nrad), the position's expected error (expected_error_mm, one sigma, 3-D, from the
calibration's covariance alone), and ok or why there is no command.

Exit status: 0 a command for every row, 1 some rows were refused, 2 bad input.
)";

/// Takes "--name value" and "--name=value"; false at anything else.
bool Parse(int argc, char** argv, CompensateOptions* options, std::string* wrong) {
  const auto texts = {std::pair("model", &options->model),
                      std::pair("poses", &options->poses),
                      std::pair("nominal", &options->nominal),
                      std::pair("frame", &options->frame),
                      std::pair("seed_deg", &options->seed),
                      std::pair("result", &options->result),
                      std::pair("out", &options->out),
                      std::pair("data_dir", &options->data_dir)};
  for (int k = 1; k < argc; ++k) {
    std::string name = argv[k];
    *wrong = name;
    if (name.rfind("--", 0) != 0) return false;
    name = name.substr(2);
    const std::size_t equals = name.find('=');
    std::string value;
    if (equals != std::string::npos) {
      value = name.substr(equals + 1);
      name = name.substr(0, equals);
    }
    std::replace(name.begin(), name.end(), '-', '_');
    if (name == "predict" && equals == std::string::npos) {
      options->predict = true;
      continue;
    }
    const auto text = std::find_if(
        texts.begin(), texts.end(), [&](const auto& entry) { return name == entry.first; });
    if (text == texts.end()) return false;
    if (equals == std::string::npos) {
      if (k + 1 == argc) return false;
      value = argv[++k];
    }
    *text->second = value;
  }
  return true;
}

int Main(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    if (std::string(argv[k]) == "--help") {
      std::cout << kHelp;
      return kCompensateOk;
    }
  }
  CompensateOptions options;
  std::string wrong;
  if (const char* const data = std::getenv("DHCAL_DATA")) options.data_dir = data;
  if (!Parse(argc, argv, &options, &wrong)) {
    std::cerr << "dhcal_compensate: '" << wrong << "' is no flag or lacks its value; see --help\n";
    return kCompensateBadInput;
  }
  return RunCompensate(options, std::cout, std::cerr);
}

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  dhcal::StartQuietLog(argv[0]);
  try {
    return dhcal::Main(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "dhcal_compensate: internal error: " << error.what() << "\n";
    return dhcal::kCompensateRefused;
  }
}
