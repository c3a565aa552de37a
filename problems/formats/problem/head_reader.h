// Reads `measurement.head` and `measurement.edges` of the kind that reads along straight edges.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_HEAD_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_HEAD_READER_H_

#include <vector>

#include "core/io/yaml_map.h"
#include "core/io/yaml_value.h"
#include "core/model/problem_spec.h"

namespace dhcal {

/// `{camera: {xyz_mm, axis, sigma_mm}, laser1: {...}, laser2: {...}, ruler_height_mm}`. Noise of
/// single sensors becomes `measurement->sigma` (the camera's, where no common one is given) and the
/// kind's coordinates in terms of it.
void ReadHead(const YamlValue& value, MeasurementSpec* measurement);

/// `{north: {xyz_mm, rpy_deg}, south: {}}`, or names alone: `[north, south]`.
void ReadEdges(const YamlValue& value, std::vector<Edge>* edges);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_HEAD_READER_H_
