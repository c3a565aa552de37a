// dhcal_plan: which poses to measure so that a calibration serves best.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <utility>

#include "core/base/quiet_log.h"
#include "tools/plan/run.h"

namespace dhcal {
namespace {

constexpr char kHelp[] =
    R"(dhcal_plan: which poses to measure so that a calibration serves best.

  dhcal_plan --problem my_robot.yaml [--poses 100] [--out poses.csv] [options]

  --problem FILE      the problem file: robot (with limits_deg of its joints), measurement with its
                      noise, parameters; its task is where accuracy matters (default: everywhere).
                      A recording that is there already is judged beside the plan
  --poses N           poses to choose (default 100); along straight edges placements (default 12)
  --candidates M      random candidates to choose from (default 1000; placements 600)
  --criterion C       D (default): the smallest uncertainty of the parameters; I: the smallest
                      error in the region of the task
  --volume_m BOX      x,y,z,x,y,z: two corners of the space that the instrument sees, in the
                      robot's base
  --seed S            of the candidates (default 1)
  --out FILE          default: <problem's name>_plan.csv
  --data_dir DIR      what ${DHCAL_DATA} in a problem file stands for (default: the environment
                      variable)

  --split             poses (default 10) that tell apart the alternatives of an ambiguous diagnosis
                      of the recording, to be measured in addition; it is diagnosed first, or
  --result FILE       that result.json says what the alternatives are

  Along straight edges: --edge_length_mm 500, --edge_poses 20 (along each), --tilt_deg 25 (of the
  tool, at random), --stand_off_mm 60 (of the tool point from the face), --slope_deg 20 (of the face
  against the horizontal of the base, at most).

Output: the poses as a recording without readings (q1_rad ..., the edge of each row), and a table of
what as many poses let expect.

Exit status: 0 a plan was written, 2 bad input or no plan.
)";

/// Takes "--name value" and "--name=value"; false at anything else.
bool Parse(int argc, char** argv, PlanCommand* command, std::string* wrong) {
  const auto texts = {std::pair("problem", &command->problem),
                      std::pair("poses", &command->poses),
                      std::pair("candidates", &command->candidates),
                      std::pair("criterion", &command->criterion),
                      std::pair("volume_m", &command->volume),
                      std::pair("seed", &command->seed),
                      std::pair("out", &command->out),
                      std::pair("result", &command->result),
                      std::pair("edge_length_mm", &command->edge_length),
                      std::pair("edge_poses", &command->edge_poses),
                      std::pair("tilt_deg", &command->tilt),
                      std::pair("slope_deg", &command->slope),
                      std::pair("stand_off_mm", &command->stand_off),
                      std::pair("data_dir", &command->data_dir)};
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
    if (name == "split" && equals == std::string::npos) {
      command->split = true;
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
      return kPlanOk;
    }
  }
  PlanCommand command;
  std::string wrong;
  if (const char* const data = std::getenv("DHCAL_DATA")) command.data_dir = data;
  if (!Parse(argc, argv, &command, &wrong)) {
    std::cerr << "dhcal_plan: '" << wrong << "' is no flag or lacks its value; see --help\n";
    return kPlanBadInput;
  }
  return RunPlan(command, std::cout, std::cerr);
}

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  dhcal::StartQuietLog(argv[0]);
  try {
    return dhcal::Main(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "dhcal_plan: internal error: " << error.what() << "\n";
    return dhcal::kPlanFailed;
  }
}
