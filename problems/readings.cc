#include "problems/readings.h"

#include <map>
#include <utility>

namespace dhcal {
namespace {

bool Present(const Eigen::MatrixXd& column, int row_idx) {
  return column.rows() > 0 && column.row(row_idx).allFinite();
}

bool HasReading(MeasurementKind kind, const Recording& recording, int row_idx) {
  switch (kind) {
    case MeasurementKind::kPosition:
      return Present(recording.p_WQ, row_idx);
    case MeasurementKind::kPose:
      return Present(recording.p_WQ, row_idx) && Present(recording.quaternion, row_idx);
    case MeasurementKind::kDistance:
      return Present(recording.distance, row_idx) && recording.anchor_idx[row_idx] >= 0;
    case MeasurementKind::kAdjacentPosition:
      break;
  }
  return false;
}

Readings CollectPairs(const Recording& recording) {
  const bool displacements = HasDisplacements(recording);
  Readings readings;
  // The latest row of each run and target that a later one may be paired with.
  std::map<std::pair<int, int>, int> latest;
  for (int row_idx = 0; row_idx < recording.num_rows(); ++row_idx) {
    const auto series = std::make_pair(recording.run(row_idx), recording.target(row_idx));
    // Displacements lead from row to row; of positions a blank one is skipped.
    if (!displacements && !Present(recording.p_WQ, row_idx)) continue;
    const auto before = latest.find(series);
    if (before != latest.end() && (!displacements || Present(recording.displacement, row_idx))) {
      const bool test = recording.test(row_idx) || recording.test(before->second);
      (test ? readings.test : readings.fitted).push_back({row_idx, before->second});
    }
    latest[series] = row_idx;
  }
  return readings;
}

}  // namespace

int NumCoordinates(MeasurementKind kind) {
  if (kind == MeasurementKind::kPose) return 6;
  return kind == MeasurementKind::kDistance ? 1 : 3;
}

bool HasDisplacements(const Recording& recording) { return recording.displacement.rows() > 0; }

Readings CollectReadings(const MeasurementSpec& measurement, const Recording& recording) {
  if (measurement.kind == MeasurementKind::kAdjacentPosition) return CollectPairs(recording);
  Readings readings;
  for (int row_idx = 0; row_idx < recording.num_rows(); ++row_idx) {
    if (!HasReading(measurement.kind, recording, row_idx)) continue;
    (recording.test(row_idx) ? readings.test : readings.fitted).push_back({row_idx, -1});
  }
  return readings;
}

Eigen::Vector3d MeasuredDisplacement(const Recording& recording, const Reading& reading) {
  if (HasDisplacements(recording)) return recording.displacement.row(reading.row_idx);
  return recording.p_WQ.row(reading.row_idx) - recording.p_WQ.row(reading.previous_idx);
}

}  // namespace dhcal
