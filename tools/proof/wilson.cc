#include "tools/proof/wilson.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace dhcal {

RateInterval WilsonInterval(int hits, int trials) {
  if (trials <= 0) return {};
  constexpr double kNormal = 1.959963984540054;  // two-sided 95 %
  const double n = trials, p = hits / n, z2 = kNormal * kNormal;
  const double middle = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kNormal * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n)) / (1 + z2 / n);
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

std::string RateText(int hits, int trials) {
  if (trials <= 0) return "-";
  const RateInterval interval = WilsonInterval(hits, trials);
  return fmt::format("{}/{} {:.0f} % ({:.0f}-{:.0f})",
                     hits,
                     trials,
                     100.0 * hits / trials,
                     100 * interval.low,
                     100 * interval.high);
}

}  // namespace dhcal
