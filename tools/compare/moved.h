// By how much two results differ, parameter by parameter.
#ifndef DHCAL_TOOLS_COMPARE_MOVED_H_
#define DHCAL_TOOLS_COMPARE_MOVED_H_

#include <string>
#include <vector>

#include "tools/compare/read_result.h"

namespace dhcal {

struct PairedParameter {
  std::string name, unit;
  double a = kNotSet, b = kNotSet, sigma = kNotSet;  // SI; sigma of b - a, independent recordings
  double sigmas() const { return (b - a) / sigma; }
};

struct Moved {
  std::vector<PairedParameter> determined;        // in both; the farthest in sigmas first
  std::vector<std::string> only_a, only_b, open;  // names; open = not determined in one or both
};

Moved MovedBetween(const ReadResult& a, const ReadResult& b);

enum class Better { kA, kB, kAlike, kNotKnown };

/// Which predicts rows better that it has not seen: `kAlike` where the ratio of their errors is
/// within two sigmas of one, an RMS of n normal numbers being known to 1 / sqrt(2 n).
Better BetterOnUnseenRows(const ReadResult& a, const ReadResult& b);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_COMPARE_MOVED_H_
