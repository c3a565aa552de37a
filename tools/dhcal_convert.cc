// dhcal_convert: a robot from one form into another.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <utility>

#include "core/base/quiet_log.h"
#include "tools/convert/run.h"

namespace dhcal {
namespace {

constexpr char kHelp[] =
    R"(dhcal_convert: a robot's geometry from one form into another.

  dhcal_convert --from FILE --to FILE [options]

  --from FILE        arm.urdf, a problem file or calibrated.yaml, a UR controller's calibration.conf,
                     or a kinematics_params_file of ROS' UR drivers
  --to FILE          robot.yaml (the robot of a problem file) or arm.urdf
  --kind K           what --to is, where its name does not say so: robot, urdf, ros_kinematics
  --base-link L      of a URDF: where the chain begins (default: the root)
  --tip-link L       of a URDF: where it ends (default: the only link that nothing hangs from)
  --convention C     of robot.yaml: standard or modified (default: as read; of others standard)
  --urdf FILE        with calibrated.yaml: the URDF that its rows come from. Its joints' origins are
                     corrected, the rest of it stays byte for byte
  --nominal FILE     with calibration.conf: the problem file of the rows that it corrects
  --hash H           of ros_kinematics: calib_..., as the controller's
  --data_dir DIR     what ${DHCAL_DATA} in a problem file stands for (default: the environment
                     variable)

What a form cannot hold (effects of calibrated.yaml) is said, and written into the file as a comment.
Exit status: 0 written, 2 bad input or not written.
)";

/// Takes "--name value" and "--name=value"; false at anything else.
bool ParseConvert(int argc, char** argv, ConvertOptions* options, std::string* wrong) {
  const auto texts = {std::pair("from", &options->from),
                      std::pair("to", &options->to),
                      std::pair("kind", &options->kind),
                      std::pair("base_link", &options->base_link),
                      std::pair("tip_link", &options->tip_link),
                      std::pair("convention", &options->convention),
                      std::pair("urdf", &options->urdf),
                      std::pair("nominal", &options->nominal),
                      std::pair("hash", &options->hash),
                      std::pair("data_dir", &options->data_dir)};
  for (int k = 1; k < argc; ++k) {
    std::string name = argv[k];
    *wrong = name;
    if (name.rfind("--", 0) != 0) return false;
    name = name.substr(2);
    const std::size_t equals = name.find('=');
    std::string value = equals == std::string::npos ? "" : name.substr(equals + 1);
    name = name.substr(0, equals);
    std::replace(name.begin(), name.end(), '-', '_');
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

int ConvertMain(int argc, char** argv) {
  const auto asks = [](const char* argument) { return std::string(argument) == "--help"; };
  if (std::any_of(argv + 1, argv + argc, asks)) {
    std::cout << kHelp;
    return kConvertOk;
  }
  ConvertOptions options;
  std::string wrong;
  if (const char* const data = std::getenv("DHCAL_DATA")) options.data_dir = data;
  if (!ParseConvert(argc, argv, &options, &wrong)) {
    std::cerr << "dhcal_convert: '" << wrong << "' is no flag or lacks its value; see --help\n";
    return kConvertBadInput;
  }
  return RunConvert(options, std::cerr);
}

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  dhcal::StartQuietLog(argv[0]);
  try {
    return dhcal::ConvertMain(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "dhcal_convert: internal error: " << error.what() << "\n";
    return dhcal::kConvertFailed;
  }
}
