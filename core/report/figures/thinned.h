// Which of many points are drawn.
#ifndef DHCAL_CORE_REPORT_FIGURES_THINNED_H_
#define DHCAL_CORE_REPORT_FIGURES_THINNED_H_

#include <cstddef>
#include <string>

namespace dhcal {

/// Every step-th of `count` points, at most `most` of them.
struct Thinned {
  Thinned(std::size_t points, std::size_t most) : count(points), step((points + most - 1) / most) {
    if (step == 0) step = 1;
  }
  std::size_t count, step;

  /// " Drawn is every 12th row." with `what` = "row"; "" where all are drawn.
  std::string Words(const std::string& what) const;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_FIGURES_THINNED_H_
