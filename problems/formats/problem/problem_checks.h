// Whether a recording is one that its problem can be solved with.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_PROBLEM_CHECKS_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_PROBLEM_CHECKS_H_

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"

namespace dhcal {

/// Reports a recording that is not there, at the line that names it, with the folder searched and
/// the file there whose name comes nearest. True if it may be read.
bool CheckRecordingExists(const ProblemSpec& spec, Diagnostics* diagnostics);

/// Reports columns that the kind of measurement needs and names (of targets, anchors and runs)
/// that one file uses and the other does not have. Names that no row uses are warnings.
void CheckRecordingFits(const ProblemSpec& spec,
                        const Recording& recording,
                        Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_PROBLEM_CHECKS_H_
