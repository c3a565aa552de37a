// The model that a diagnosis announces, fitted as the problem file asks: its geometry, what was
// found missing in it, and the effects, all as unknowns of one fit.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_DELIVER_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_DELIVER_H_

#include <optional>

#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"
#include "problems/fit.h"

namespace dhcal {

/// Fills result->delivered and the rows' third prediction from result->diagnosis. Nothing where
/// nothing was found; a note where the fit did not reach the error that the diagnosis announces.
void Deliver(const ProblemSpec& spec,
             const Recording& recording,
             const Progress& progress,
             Result* result);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_DELIVER_H_
