#include "tools/support/progress_printer.h"

#include <iostream>

#include <fmt/format.h>

namespace dhcal {
namespace {

constexpr std::chrono::seconds kSilence(2);
constexpr std::chrono::seconds kInterval(1);

}  // namespace

void ProgressPrinter::operator()(const std::string& text) {
  const Clock::time_point now = Clock::now();
  if (now - begin_ < kSilence || now - latest_ < kInterval) return;
  latest_ = now;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  std::cerr << fmt::format("[{:5.1f} s] {}\n", seconds, text) << std::flush;
}

}  // namespace dhcal
