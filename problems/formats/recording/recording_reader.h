// Reads a recording (a text table), independent of the locale. All errors are collected.
#ifndef DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_READER_H_
#define DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_READER_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/recording.h"
#include "core/model/robot.h"

namespace dhcal {

/// Reads `file` for a robot with these joints (their types decide between q1_deg and q1_mm).
/// Returns the recording, or nothing when `diagnostics` received an error. Unknown columns are
/// kept as `extra` and named in one warning; notes say what was read in another form than ours.
/// `columns` says which columns of the file stand for ours.
std::optional<Recording> ReadRecording(const std::string& file,
                                       const std::vector<JointRow>& joints,
                                       const std::vector<ColumnAlias>& columns,
                                       Diagnostics* diagnostics);

/// The same without such words.
std::optional<Recording> ReadRecording(const std::string& file,
                                       const std::vector<JointRow>& joints,
                                       Diagnostics* diagnostics);

/// A table of poses to go to, in the same columns; without joint coordinates they are NaN.
std::optional<Recording> ReadPoses(const std::string& file,
                                   const std::vector<JointRow>& joints,
                                   Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_READER_H_
