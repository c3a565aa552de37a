#include "residuals/registry.h"

#include <glog/logging.h>

namespace dhcal {

// One line per kind: DHCAL_KIND(X) is the function X() that its file in kinds/ defines.
#define DHCAL_KIND_LIST(DHCAL_KIND)       \
  DHCAL_KIND(AdjacentPositionMeasurement) \
  DHCAL_KIND(PositionMeasurement)         \
  DHCAL_KIND(PoseMeasurement)             \
  DHCAL_KIND(DistanceMeasurement)         \
  DHCAL_KIND(StraightEdgeMeasurement)

#define DHCAL_DECLARE(name) const MeasurementType& name();
DHCAL_KIND_LIST(DHCAL_DECLARE)
#undef DHCAL_DECLARE

Eigen::Matrix3d Measurement::Orientation(const Reading& /*reading*/) const {
  LOG(FATAL) << "'" << kind().name << "' sees no orientation";
}

const std::vector<const MeasurementType*>& AllMeasurementTypes() {
#define DHCAL_POINTER(name) &name(),
  static const std::vector<const MeasurementType*> types = {DHCAL_KIND_LIST(DHCAL_POINTER)};
#undef DHCAL_POINTER
  return types;
}

const MeasurementType* FindMeasurementType(const std::string& name) {
  for (const MeasurementType* const type : AllMeasurementTypes()) {
    if (type->Describe().name == name) return type;
  }
  return nullptr;
}

MeasurementKind KindNamed(const std::string& name) {
  const MeasurementType* const type = FindMeasurementType(name);
  CHECK(type != nullptr) << "no kind of measurement is called '" << name << "'";
  return type->Describe();
}

std::unique_ptr<Measurement> MakeMeasurement(const MeasurementSpec& spec,
                                             const Recording& recording) {
  const MeasurementType* const type = FindMeasurementType(spec.kind.name);
  CHECK(type != nullptr) << "no kind of measurement is called '" << spec.kind.name << "'";
  return type->Bind(spec, recording);
}

}  // namespace dhcal
