// The rows of a problem, ready to be computed with.
#ifndef DHCAL_PROBLEMS_RECORDING_OF_H_
#define DHCAL_PROBLEMS_RECORDING_OF_H_

#include <optional>

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"

namespace dhcal {

/// Reads or simulates the recording of a problem and checks that it fits to it and holds enough
/// readings. Nothing after an error that leaves no rows to look at.
std::optional<Recording> RecordingOf(const ProblemSpec& spec, Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_RECORDING_OF_H_
