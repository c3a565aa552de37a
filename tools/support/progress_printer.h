// Progress on the terminal, only once a run has become long.
#ifndef DHCAL_TOOLS_SUPPORT_PROGRESS_PRINTER_H_
#define DHCAL_TOOLS_SUPPORT_PROGRESS_PRINTER_H_

#include <chrono>
#include <string>

#include "problems/progress.h"

namespace dhcal {

/// Prints to stderr what it is told, at most about once a second and not in the first two: a short
/// run stays silent, a long one shows that it lives, how far it is and how long it will still take.
class ProgressPrinter {
 public:
  void operator()(const ProgressStep& step);
  /// Printed as soon as anything is, and whole.
  void Announce(const std::string& text) { announced_ += text; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point latest_ = begin_;
  std::string announced_;
  double share_ = 0;  // the latest that was told
};

}  // namespace dhcal

#endif  // DHCAL_TOOLS_SUPPORT_PROGRESS_PRINTER_H_
