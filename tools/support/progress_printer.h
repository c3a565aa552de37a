// Progress on the terminal, only once a run has become long.
#ifndef DHCAL_TOOLS_SUPPORT_PROGRESS_PRINTER_H_
#define DHCAL_TOOLS_SUPPORT_PROGRESS_PRINTER_H_

#include <chrono>
#include <string>

namespace dhcal {

/// Prints to stderr what it is told, at most about once a second and not in the first two: a short
/// run stays silent, a long one shows that it lives.
class ProgressPrinter {
 public:
  void operator()(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point latest_ = begin_;
};

}  // namespace dhcal

#endif  // DHCAL_TOOLS_SUPPORT_PROGRESS_PRINTER_H_
