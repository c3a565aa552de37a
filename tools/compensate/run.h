// A whole run of dhcal_compensate.
#ifndef DHCAL_TOOLS_COMPENSATE_RUN_H_
#define DHCAL_TOOLS_COMPENSATE_RUN_H_

#include <ostream>
#include <string>

namespace dhcal {

constexpr int kCompensateOk = 0;
constexpr int kCompensateRefused = 1;
constexpr int kCompensateBadInput = 2;

/// As the command line has them; empty = not given.
struct CompensateOptions {
  std::string model, poses, nominal, result, out, data_dir;
  std::string frame = "base";
  std::string seed;  // "0,-90,90", deg or mm
  bool predict = false;
};

/// Exit status. The table goes to the file `options.out` as a whole, or to `out`; messages to
/// `messages`.
int RunCompensate(const CompensateOptions& options, std::ostream& out, std::ostream& messages);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_COMPENSATE_RUN_H_
