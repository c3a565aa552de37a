// dhcal_convert: a robot from one form into another.
#include <iostream>

#include "tools/convert/run.h"
#include "tools/support/flags.h"

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

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  dhcal::ConvertOptions options;
  dhcal::FlagProgram program;
  program.name = "dhcal_convert";
  program.help = dhcal::kHelp;
  program.flags.texts = {{"from", &options.from},
                         {"to", &options.to},
                         {"kind", &options.kind},
                         {"base_link", &options.base_link},
                         {"tip_link", &options.tip_link},
                         {"convention", &options.convention},
                         {"urdf", &options.urdf},
                         {"nominal", &options.nominal},
                         {"hash", &options.hash},
                         {"data_dir", &options.data_dir}};
  program.data_dir = &options.data_dir;
  program.run = [&] { return dhcal::RunConvert(options, std::cerr); };
  return dhcal::RunFlagProgram(argc, argv, program);
}
