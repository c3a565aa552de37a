// The task: identify a robot's geometry from a recording.
#ifndef DHCAL_PROBLEMS_IDENTIFY_H_
#define DHCAL_PROBLEMS_IDENTIFY_H_

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"
#include "problems/fit.h"

namespace dhcal {

/// Adds an error when the recording has fewer readings than the problem has free parameters.
void CheckEnoughReadings(const ProblemSpec& spec,
                         const Recording& recording,
                         Diagnostics* diagnostics);

/// Start, solve with the methods asked for, analyse, validate. The inputs have been checked.
Result IdentifyGeometry(const ProblemSpec& spec,
                        const Recording& recording,
                        const Progress& progress);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_IDENTIFY_H_
