// Whether a problem file and a recording can belong together, and what is wrong where they cannot:
// plain data in SI units, like the rest of a Result.
#ifndef DHCAL_CORE_MODEL_SETUP_H_
#define DHCAL_CORE_MODEL_SETUP_H_

#include <limits>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"

namespace dhcal {

/// One thing that the files say wrongly, and the line that cures it.
struct SetupCause {
  /// "joint_sense", "joint_order", "zero_offset", ... (FORMATS.md, section 3).
  std::string kind;
  std::vector<int> joints;  // concerned, from 1; empty where none is
  std::string sentence;
  SourceLocation where;  // which line to change
  std::string text;      // what to write there
  /// The nominal robot with base and tool fitted, RMS in 3-D [m]: as the files stand, and with all
  /// causes of this alternative cured.
  double rms_before = std::numeric_limits<double>::quiet_NaN();
  double rms_after = std::numeric_limits<double>::quiet_NaN();
  /// Causes with the same number belong together. From 1, best first; base and tool can absorb
  /// what tells alternatives apart.
  int alternative = 1;
};

struct SetupResult {
  /// False: what was fitted is no calibration, and nothing of it is delivered.
  bool plausible = true;
  std::vector<std::string> reasons;  // why not, as sentences
  std::vector<SetupCause> causes;
  bool cured = false;  // the causes of the first alternative were cured in memory, and the rest of
                       // the result is of the cured files
  std::vector<std::string> remarks;  // on the input, where it is odd but usable
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_SETUP_H_
