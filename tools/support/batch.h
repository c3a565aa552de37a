// Runs problem files one after the other, as ceres_dhcal does.
#ifndef DHCAL_TOOLS_SUPPORT_BATCH_H_
#define DHCAL_TOOLS_SUPPORT_BATCH_H_

#include "tools/support/command_line.h"

namespace dhcal {

constexpr int kExitOk = 0;
constexpr int kExitNoUsableResult = 1;
constexpr int kExitBadInput = 2;
constexpr int kExitNotAccepted = 3;

/// Reads and checks all inputs first; with any error prints them all and writes nothing. Returns
/// the exit status; of several problems the worst: bad input, no usable result, not accepted.
int RunBatch(const CommandLine& command_line);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_SUPPORT_BATCH_H_
