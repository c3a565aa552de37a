// Reads the section `measurement` of a problem file.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_MEASUREMENT_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_MEASUREMENT_READER_H_

#include "core/io/yaml_value.h"
#include "core/model/problem_spec.h"

namespace dhcal {

void ReadMeasurement(const YamlValue& value, MeasurementSpec* measurement);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_MEASUREMENT_READER_H_
