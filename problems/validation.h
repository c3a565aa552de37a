// How well a fit predicts rows that it never saw.
#ifndef DHCAL_PROBLEMS_VALIDATION_H_
#define DHCAL_PROBLEMS_VALIDATION_H_

#include "core/model/result.h"
#include "problems/calibration.h"
#include "problems/fit_analysis.h"

namespace dhcal {

/// Test rows where the recording marks some; otherwise blocks of consecutive readings are left out
/// in turn and predicted by the linear model of the others, with the noise rule's truncation.
ValidationResult Validate(const Calibration& calibration,
                          const FitAnalysis& analysis,
                          const CalibrationProblem& problem);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_VALIDATION_H_
