// The flag --accept: is the calibration as good as the user asks?
#ifndef DHCAL_TOOLS_SUPPORT_ACCEPTANCE_H_
#define DHCAL_TOOLS_SUPPORT_ACCEPTANCE_H_

#include <optional>
#include <string>

#include "core/model/result.h"

namespace dhcal {

/// "0.1mm", "100 um" -> [m]. Nothing where it is no positive length with its unit.
std::optional<double> ParseLimit(const std::string& text);

struct Acceptance {
  bool met = false;
  std::string sentence;  // why, with the figure that decides
};

/// Holds the error that the first screen announces for rows that were not fitted (RMS, in 3-D where
/// a point is read) against `limit` [m]. Not met where no row was kept unseen: nothing shows it.
/// The result has a usable fit.
Acceptance JudgeAcceptance(const Result& result, double limit);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_SUPPORT_ACCEPTANCE_H_
