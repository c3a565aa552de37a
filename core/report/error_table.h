// The error of the prediction before and after: one headline, one table, for the first screen and
// the report alike.
#ifndef DHCAL_CORE_REPORT_ERROR_TABLE_H_
#define DHCAL_CORE_REPORT_ERROR_TABLE_H_

#include <string>

#include "core/model/result.h"
#include "core/report/document.h"

namespace dhcal {

/// How the model of calibrated.yaml predicts rows that it has not seen.
const ValidationResult& DeliveredValidation(const Result& result);

/// RMS of a reading's length from the RMS of its coordinates [m]: in 3-D where the coordinates are
/// those of a point.
double InSpace(const MeasurementKind& kind, double rms_coordinate);

/// "RMS, 3-D" or, where a reading is no point, "RMS".
std::string ErrorName(const MeasurementKind& kind);

/// RMS with the nominal robot (base and tool fitted, where they are free), and with the delivered
/// model [m]; in 3-D where there is one.
double ErrorBefore(const Result& result);
double ErrorAfter(const Result& result);

/// The same of the delivered model on rows that it has not seen; NaN where there are none.
double ErrorUnseen(const Result& result);

/// The answer in a sentence: the error with the nominal robot, after calibration, and on rows that
/// were not fitted. The result has a usable fit.
std::string Headline(const Result& result);

/// The same for each model on the way, fitted and unseen rows side by side.
Table ErrorTable(const Result& result);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_ERROR_TABLE_H_
