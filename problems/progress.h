// What a long run tells of itself while it works.
#ifndef DHCAL_PROBLEMS_PROGRESS_H_
#define DHCAL_PROBLEMS_PROGRESS_H_

#include <functional>
#include <limits>
#include <string>

namespace dhcal {

struct ProgressStep {
  std::string text;  // what begins now
  /// Part of the whole run that lies behind it, 0 to 1, from runs that were timed; NaN where that
  /// is not known. A run that needs fewer rounds than it may jumps ahead, one that must be made
  /// once more falls back.
  double share = std::numeric_limits<double>::quiet_NaN();
};

// Where the stages of a run with a diagnosis begin, as shares of it.
constexpr double kShareAtStart = 0.05;
constexpr double kShareAtRounds = 0.14;
constexpr double kShareAfterRounds = 0.56;
constexpr double kShareAtAlternatives = 0.58;
constexpr double kShareAtUnseen = 0.66;
constexpr double kShareAtHidden = 0.84;
constexpr double kShareAtDelivery = 0.87;

/// Called now and then during long work; may be empty.
using Progress = std::function<void(const ProgressStep&)>;

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_PROGRESS_H_
