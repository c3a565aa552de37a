// Which rows of a recording give readings, which of them are fitted, and how they are paired.
#ifndef DHCAL_RESIDUALS_READINGS_H_
#define DHCAL_RESIDUALS_READINGS_H_

#include "core/model/reading.h"
#include "core/model/recording.h"
#include "residuals/measurement.h"

namespace dhcal {

/// Rows whose cells for this kind are blank give no reading. A pair is of one run, one target and
/// one edge; it is fitted only if no row of it is a test row. `anchored`: the first row of each run
/// and target is read by itself, too, where its position is known.
Readings CollectReadings(const Measurement& measurement, const Recording& recording, bool anchored);

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_READINGS_H_
