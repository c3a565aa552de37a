// dhcal_plan: which poses to measure so that a calibration serves best.
#include <iostream>

#include "tools/plan/run.h"
#include "tools/support/flags.h"

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

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  dhcal::PlanCommand command;
  dhcal::FlagProgram program;
  program.name = "dhcal_plan";
  program.help = dhcal::kHelp;
  program.flags.texts = {{"problem", &command.problem},
                         {"poses", &command.poses},
                         {"candidates", &command.candidates},
                         {"criterion", &command.criterion},
                         {"volume_m", &command.volume},
                         {"seed", &command.seed},
                         {"out", &command.out},
                         {"result", &command.result},
                         {"edge_length_mm", &command.edge_length},
                         {"edge_poses", &command.edge_poses},
                         {"tilt_deg", &command.tilt},
                         {"slope_deg", &command.slope},
                         {"stand_off_mm", &command.stand_off},
                         {"data_dir", &command.data_dir}};
  program.flags.switches = {{"split", &command.split}};
  program.data_dir = &command.data_dir;
  program.run = [&] { return dhcal::RunPlan(command, std::cout, std::cerr); };
  return dhcal::RunFlagProgram(argc, argv, program);
}
