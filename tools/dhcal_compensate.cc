// dhcal_compensate: joint commands at which the real robot holds its tool where it is wanted.
#include <iostream>

#include "tools/compensate/run.h"
#include "tools/support/flags.h"

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

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  dhcal::CompensateOptions options;
  dhcal::FlagProgram program;
  program.name = "dhcal_compensate";
  program.help = dhcal::kHelp;
  program.flags.texts = {{"model", &options.model},
                         {"poses", &options.poses},
                         {"nominal", &options.nominal},
                         {"frame", &options.frame},
                         {"seed_deg", &options.seed},
                         {"result", &options.result},
                         {"out", &options.out},
                         {"data_dir", &options.data_dir}};
  program.flags.switches = {{"predict", &options.predict}};
  program.data_dir = &options.data_dir;
  program.run = [&] { return dhcal::RunCompensate(options, std::cout, std::cerr); };
  return dhcal::RunFlagProgram(argc, argv, program);
}
