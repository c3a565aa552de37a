#include "problems/prediction.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dhcal {
namespace {

SeenPose Seen(const Calibration& c, const Eigen::VectorXd& state, int row_idx) {
  const Eigen::Isometry3d X_WQ = c.Pose(state, row_idx);
  return {X_WQ.translation(), X_WQ.linear()};
}

}  // namespace

Comparison Compare(const Calibration& c, const Eigen::VectorXd& state, const Reading& reading) {
  const SeenPose now = Seen(c, state, reading.row_idx);
  std::optional<SeenPose> before;
  if (reading.previous_idx >= 0) before = Seen(c, state, reading.previous_idx);
  const SeenPose* const previous = before ? &*before : nullptr;
  const ReadingNumbers numbers = c.measurement->Numbers(reading, now, previous);
  ReadingComparison comparison(c.measurement->kind().num_coordinates());
  // The difference is defined wherever the readings are, even where its derivative is not.
  c.measurement->Compare(reading, now, previous, &comparison);
  return {numbers.measured, numbers.predicted, -comparison.difference};
}

ResidualStatistics Statistics(const Calibration& calibration,
                              const Eigen::VectorXd& state,
                              const std::vector<Reading>& readings) {
  ResidualStatistics result;
  double lengths = 0, rotations = 0, largest = 0;
  for (const Reading& reading : readings) {
    const Eigen::VectorXd residual = Compare(calibration, state, reading).residual;
    const Eigen::Index num_lengths = calibration.measurement->kind().num_lengths();
    const double square = residual.head(num_lengths).squaredNorm();
    lengths += square;
    largest = std::max(largest, square);
    rotations += residual.tail(residual.size() - num_lengths).squaredNorm();
    result.num_lengths += static_cast<int>(num_lengths);
    result.num_rotations += static_cast<int>(residual.size() - num_lengths);
  }
  if (readings.empty()) return result;
  result.rms = std::sqrt(lengths / result.num_lengths);
  if (calibration.measurement->kind().is_point()) {
    result.rms_point = std::sqrt(lengths / static_cast<double>(readings.size()));
    result.max_point = std::sqrt(largest);
  }
  if (result.num_rotations > 0) result.rms_rotation = std::sqrt(rotations / result.num_rotations);
  return result;
}

}  // namespace dhcal
