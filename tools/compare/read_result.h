// What a comparison needs of a result folder.
#ifndef DHCAL_TOOLS_COMPARE_READ_RESULT_H_
#define DHCAL_TOOLS_COMPARE_READ_RESULT_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/result.h"

namespace dhcal {

struct ReadParameter {
  std::string name, unit;
  double value = kNotSet, sigma = kNotSet;  // SI
  bool determined = false;                  // identified or weak: it means something by itself
};

/// Lengths in metres: RMS over readings, of points in 3-D, of the model that calibrated.yaml holds.
struct ReadResult {
  std::string folder, problem, kind, diagnosis;  // diagnosis: its verdict, or empty
  int rows = 0;                                  // fitted
  int unseen_rows = 0;
  std::string unseen_method;  // "set column" or "blocked k-fold"; empty = none were kept
  bool in_space = false;      // of points
  bool intervals_hold = false;
  double before = kNotSet, fitted = kNotSet, fitted_max = kNotSet;
  double unseen = kNotSet, unseen_max = kNotSet, noise = kNotSet;
  std::vector<std::string> effects;  // "joint_compliance, joint 2"
  std::vector<ReadParameter> parameters;
};

/// Reads `folder`/result.json. Nothing, with an error added, where it is no result, or one without
/// a usable fit.
std::optional<ReadResult> ReadResultFolder(const std::string& folder, Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_COMPARE_READ_RESULT_H_
