// A whole run of dhcal_ruler.
#ifndef DHCAL_TOOLS_CAMERA_RUN_H_
#define DHCAL_TOOLS_CAMERA_RUN_H_

#include <ostream>
#include <string>
#include <vector>

namespace dhcal {

constexpr int kRulerOk = 0;
constexpr int kRulerSkipped = 1;
constexpr int kRulerBadInput = 2;

/// As the command line has them; empty = not given.
struct RulerCommand {
  std::vector<std::string> images;
  std::string pitch, readings, coarse, coarse_error, step, lens, calibrate, out, details;
  std::string direction = "right", rulings = "dark", longest_gap = "3", threads = "2";
  std::string data_dir;  // not used: images are named on the command line
  bool skip = false;
};

/// Exit status. Tables go to their files as wholes, or to `out`; messages to `messages`.
int RunRuler(const RulerCommand& command, std::ostream& out, std::ostream& messages);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_RUN_H_
