// dhcal_ruler: photographs of a ruled edge become the readings of a recording.
#include <iostream>

#include "tools/camera/run.h"
#include "tools/support/flags.h"

namespace dhcal {
namespace {

constexpr char kHelp[] =
    R"(dhcal_ruler: photographs of a ruled edge become the ruler readings of a recording.

  dhcal_ruler IMAGE... --pitch_mm P --readings FILE [--lens lens.yaml] [--out recording.csv]
  dhcal_ruler IMAGE... --pitch_mm P --step_mm S                (the readings alone)
  dhcal_ruler IMAGE... --calibrate_lens lens.yaml              (the lens, from the rulings alone)

For each image: where the point that the lens is centred on (without a lens: the middle of the image)
lies along the ruler, and how sure that is.

  --pitch_mm P          distance between two rulings
  --readings FILE       a table with one row for each image, in their order: q1_deg ..., edge, run,
                        height1_mm, height2_mm and whatever else a recording has; coarse_mm, where
                        the camera roughly is along the ruler (or ruler_mm; both are replaced). The
                        output is this table with ruler_mm: a recording
  --coarse FILE         takes coarse_mm from another table of as many rows
  --step_mm S           instead of coarse_mm: how far the camera moved from each image to the next
  --coarse_error_mm E   how wrong a coarse move between two images may be, at most 0.45 pitches
                        (default: a quarter of the pitch)
  --direction D         where the ruler's numbers grow in the image: right (default), left, down, up
  --rulings W           dark (default) or light lines
  --longest_gap N       rulings missing side by side that are still counted across (default 3)
  --lens FILE           undoes the lens' distortion, as --calibrate_lens found it
  --calibrate_lens FILE finds the distortion that makes the rulings of all images straight and evenly
                        spaced, and writes it with its uncertainties. No pitch is needed
  --skip_unreadable     leave the rows blank whose image cannot be read or counted, instead of
                        writing nothing
  --out FILE            default: the terminal
  --details FILE        a table of the readings, their sigmas and the rulings found
  --threads N           images read at a time (default 2); the numbers do not depend on it

Output: with --readings a recording; otherwise the table of --details.

Exit status: 0 every image was read, 1 rows were left blank (--skip_unreadable), 2 bad input or an
image that cannot be read or counted: nothing was written.
)";

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  dhcal::RulerCommand command;
  dhcal::FlagProgram program;
  program.name = "dhcal_ruler";
  program.help = dhcal::kHelp;
  program.flags.texts = {{"pitch_mm", &command.pitch},
                         {"readings", &command.readings},
                         {"coarse", &command.coarse},
                         {"coarse_error_mm", &command.coarse_error},
                         {"step_mm", &command.step},
                         {"direction", &command.direction},
                         {"rulings", &command.rulings},
                         {"longest_gap", &command.longest_gap},
                         {"lens", &command.lens},
                         {"calibrate_lens", &command.calibrate},
                         {"out", &command.out},
                         {"details", &command.details},
                         {"threads", &command.threads}};
  program.flags.switches = {{"skip_unreadable", &command.skip}};
  program.flags.words = &command.images;
  program.data_dir = &command.data_dir;
  program.run = [&] { return dhcal::RunRuler(command, std::cout, std::cerr); };
  return dhcal::RunFlagProgram(argc, argv, program);
}
