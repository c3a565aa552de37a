// Guesses which column of a table is which, for a user to correct: `ceres_dhcal --import FILE`.
#ifndef DHCAL_PROBLEMS_FORMATS_RECORDING_IMPORT_H_
#define DHCAL_PROBLEMS_FORMATS_RECORDING_IMPORT_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/robot.h"

namespace dhcal {

/// YAML that belongs into a problem file: `columns:`, one line for each column that is ours or may
/// be, with its first values and, in a comment, whether that is sure. Without `joints`, the file's
/// own names tell how many there are, six where it has none. Nothing when the file is no table.
std::optional<std::string> ImportColumns(const std::string& file,
                                         std::vector<JointRow> joints,
                                         Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RECORDING_IMPORT_H_
