// Intervals of rates.
#ifndef DHCAL_TOOLS_PROOF_WILSON_H_
#define DHCAL_TOOLS_PROOF_WILSON_H_

#include <string>

namespace dhcal {

struct RateInterval {
  double low = 0, high = 1;
};

/// Score interval of 95 % for `hits` of `trials` (Wilson 1927); the whole range without trials.
RateInterval WilsonInterval(int hits, int trials);

/// "47/56  84 % (72-91)", or "-" without trials.
std::string RateText(int hits, int trials);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_WILSON_H_
