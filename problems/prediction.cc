#include "problems/prediction.h"

#include <algorithm>
#include <cmath>

#include "core/math/rotation.h"

namespace dhcal {
namespace {

Comparison ComparePose(const Calibration& c, const Eigen::Isometry3d& X_WQ, int row_idx) {
  const Eigen::Isometry3d measured = c.MeasuredPose(row_idx);
  Comparison result;
  result.measured.resize(6);
  result.predicted.resize(6);
  result.residual.resize(6);
  result.measured << measured.translation(), LogSO3(measured.linear());
  result.predicted << X_WQ.translation(), LogSO3(X_WQ.linear());
  result.residual << measured.translation() - X_WQ.translation(),
      LogSO3(measured.linear() * X_WQ.linear().transpose());
  return result;
}

}  // namespace

Comparison Compare(const Calibration& c, const Eigen::VectorXd& state, const Reading& reading) {
  const Eigen::Isometry3d X_WQ = c.Pose(state, reading.row_idx);
  Comparison result;
  switch (c.spec.measurement.kind) {
    case MeasurementKind::kPose:
      return ComparePose(c, X_WQ, reading.row_idx);
    case MeasurementKind::kPosition:
      result.measured = c.recording.p_WQ.row(reading.row_idx);
      result.predicted = X_WQ.translation();
      break;
    case MeasurementKind::kDistance:
      result.measured = c.recording.distance.segment(reading.row_idx, 1);
      result.predicted.setConstant(1, (X_WQ.translation() - c.Anchor(reading.row_idx)).norm());
      break;
    case MeasurementKind::kAdjacentPosition:
      result.measured = MeasuredDisplacement(c.recording, reading);
      result.predicted = X_WQ.translation() - c.Pose(state, reading.previous_idx).translation();
      break;
  }
  result.residual = result.measured - result.predicted;
  return result;
}

std::vector<std::string> CoordinateNames(MeasurementKind kind) {
  switch (kind) {
    case MeasurementKind::kPosition:
      return {"x", "y", "z"};
    case MeasurementKind::kPose:
      return {"x", "y", "z", "rx", "ry", "rz"};
    case MeasurementKind::kAdjacentPosition:
      return {"dx", "dy", "dz"};
    case MeasurementKind::kDistance:
      return {"distance"};
  }
  return {};
}

ResidualStatistics Statistics(const Calibration& calibration,
                              const Eigen::VectorXd& state,
                              const std::vector<Reading>& readings) {
  ResidualStatistics result;
  double lengths = 0, rotations = 0, largest = 0;
  for (const Reading& reading : readings) {
    const Eigen::VectorXd residual = Compare(calibration, state, reading).residual;
    const Eigen::Index num_lengths = std::min<Eigen::Index>(residual.size(), 3);
    const double square = residual.head(num_lengths).squaredNorm();
    lengths += square;
    largest = std::max(largest, square);
    rotations += residual.tail(residual.size() - num_lengths).squaredNorm();
    result.num_lengths += static_cast<int>(num_lengths);
    result.num_rotations += static_cast<int>(residual.size() - num_lengths);
  }
  if (readings.empty()) return result;
  result.rms = std::sqrt(lengths / result.num_lengths);
  if (calibration.spec.measurement.kind != MeasurementKind::kDistance) {
    result.rms_point = std::sqrt(lengths / static_cast<double>(readings.size()));
    result.max_point = std::sqrt(largest);
  }
  if (result.num_rotations > 0) result.rms_rotation = std::sqrt(rotations / result.num_rotations);
  return result;
}

}  // namespace dhcal
