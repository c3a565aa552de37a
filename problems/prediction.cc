#include "problems/prediction.h"

#include <algorithm>
#include <cmath>

#include "problems/assembly.h"

namespace dhcal {
namespace {

/// `before` may be null.
Comparison ComparisonOf(const Measurement& measurement,
                        const Reading& reading,
                        const SeenPose& now,
                        const SeenPose* before) {
  const ReadingNumbers numbers = measurement.Numbers(reading, now, before);
  ReadingComparison comparison(measurement.kind().num_coordinates());
  // The difference is defined wherever the readings are, even where its derivative is not.
  measurement.Compare(reading, now, before, &comparison);
  return {numbers.measured, numbers.predicted, -comparison.difference};
}

SeenPose Seen(const Calibration& c, const Eigen::VectorXd& state, int row_idx) {
  const Eigen::Isometry3d X_WQ = c.Pose(state, row_idx);
  return {X_WQ.translation(), X_WQ.linear()};
}

}  // namespace

Comparison Compare(const Calibration& c, const Eigen::VectorXd& state, const Reading& reading) {
  const SeenPose now = Seen(c, state, reading.row_idx);
  if (reading.previous_idx < 0) return ComparisonOf(*c.measurement, reading, now, nullptr);
  const SeenPose before = Seen(c, state, reading.previous_idx);
  return ComparisonOf(*c.measurement, reading, now, &before);
}

void VisitComparisons(const ReadingRows& rows,
                      const Eigen::VectorXd& state,
                      const std::function<void(int, const Comparison&)>& visit) {
  const ReadingModel& model = rows.model();
  rows.VisitPoses(state, [&](int k, const SeenPose& now, const SeenPose* before) {
    const Reading& reading = model.readings[static_cast<std::size_t>(k)];
    visit(k, ComparisonOf(*model.measurement, reading, now, before));
  });
}

ResidualStatistics Statistics(const ReadingRows& rows, const Eigen::VectorXd& state) {
  ResidualStatistics result;
  double lengths = 0, rotations = 0, largest = 0;
  const MeasurementKind& kind = rows.model().measurement->kind();
  const int num_lengths = kind.num_lengths();
  VisitComparisons(rows, state, [&](int /*reading*/, const Comparison& comparison) {
    const double square = comparison.residual.head(num_lengths).squaredNorm();
    lengths += square;
    largest = std::max(largest, square);
    rotations += comparison.residual.tail(kind.num_coordinates() - num_lengths).squaredNorm();
  });
  result.num_lengths = rows.num_readings() * num_lengths;
  result.num_rotations = rows.num_readings() * (kind.num_coordinates() - num_lengths);
  if (rows.num_readings() == 0) return result;
  result.rms = std::sqrt(lengths / result.num_lengths);
  if (kind.is_point()) {
    result.rms_point = std::sqrt(lengths / rows.num_readings());
    result.max_point = std::sqrt(largest);
  }
  if (result.num_rotations > 0) result.rms_rotation = std::sqrt(rotations / result.num_rotations);
  return result;
}

ResidualStatistics Statistics(const Calibration& c,
                              const Eigen::VectorXd& state,
                              const std::vector<Reading>& readings) {
  return Statistics(RowsOf(c, readings), state);
}

}  // namespace dhcal
