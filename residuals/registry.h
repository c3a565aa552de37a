// The kinds of measurement that the program knows.
#ifndef DHCAL_RESIDUALS_REGISTRY_H_
#define DHCAL_RESIDUALS_REGISTRY_H_

#include <memory>
#include <string>
#include <vector>

#include "residuals/measurement.h"

namespace dhcal {

/// In the order in which they are listed for users.
const std::vector<const MeasurementType*>& AllMeasurementTypes();

/// By the name in a problem file; null where there is none.
const MeasurementType* FindMeasurementType(const std::string& name);

/// The description of a kind that is known to exist; aborts otherwise.
MeasurementKind KindNamed(const std::string& name);

/// The measurement of `spec` on a recording; both must outlive it. Aborts on an unknown kind, which
/// readers have refused.
std::unique_ptr<Measurement> MakeMeasurement(const MeasurementSpec& spec,
                                             const Recording& recording);

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_REGISTRY_H_
