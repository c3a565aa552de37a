#include "tools/support/progress_printer.h"

#include <cmath>
#include <iostream>
#include <string>

#include <fmt/format.h>

namespace dhcal {
namespace {

constexpr std::chrono::seconds kSilence(2);
constexpr std::chrono::seconds kInterval(1);
constexpr double kShareThatTells = 0.1;  // before it, a remaining time would be a guess

/// "about 40 s left"; rounded to what can be known.
std::string RemainingText(double seconds) {
  if (seconds < 10) return "some seconds left";
  if (seconds < 90) return fmt::format("about {:.0f} s left", 10 * std::ceil(seconds / 10));
  return fmt::format("about {:.0f} min left", std::ceil(seconds / 60));
}

}  // namespace

void ProgressPrinter::operator()(const ProgressStep& step) {
  if (!std::isnan(step.share)) share_ = step.share;
  const Clock::time_point now = Clock::now();
  if (now - begin_ < kSilence || now - latest_ < kInterval) return;
  latest_ = now;
  std::cerr << announced_;
  announced_.clear();
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  std::string how_far;
  if (share_ >= kShareThatTells) {
    how_far =
        fmt::format(" {:3.0f} %, {}", 100 * share_, RemainingText(seconds * (1 - share_) / share_));
  }
  std::cerr << fmt::format("[{:5.1f} s{}] {}\n", seconds, how_far, step.text) << std::flush;
}

}  // namespace dhcal
