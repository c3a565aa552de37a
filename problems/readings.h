// Which rows of a recording give readings, which of them are fitted, and how they are paired.
#ifndef DHCAL_PROBLEMS_READINGS_H_
#define DHCAL_PROBLEMS_READINGS_H_

#include <vector>

#include <Eigen/Core>

#include "core/model/problem_spec.h"
#include "core/model/recording.h"

namespace dhcal {

/// One reading: a row, or for adjacent_position the pair of a row and its predecessor.
struct Reading {
  int row_idx = -1;
  int previous_idx = -1;  // adjacent_position only
};

struct Readings {
  std::vector<Reading> fitted;
  std::vector<Reading> test;
};

/// Rows of a residual block: 1, 3 or 6.
int NumCoordinates(MeasurementKind kind);

/// Rows whose cells for this kind are blank give no reading. A pair is of one run and one target;
/// it is fitted only if no row of it is a test row.
Readings CollectReadings(const MeasurementSpec& measurement, const Recording& recording);

/// Displacement that was measured for a pair [m].
Eigen::Vector3d MeasuredDisplacement(const Recording& recording, const Reading& reading);

/// True if pairs are read as displacements, not as positions.
bool HasDisplacements(const Recording& recording);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_READINGS_H_
