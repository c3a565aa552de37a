#include "tools/proof/simulator/random/random_readings.h"

#include <cmath>
#include <limits>
#include <vector>

#include "tools/proof/simulator/random/draw.h"
#include "tools/proof/simulator/random/observe.h"
#include "tools/proof/simulator/random/poses.h"
#include "tools/proof/simulator/screw.h"
#include "tools/proof/simulator/truth.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kOwnOfRepeat = 0.1;  // of the noise, where repeats share the rest

/// One number of unit deviation.
double DrawNoise(Tail tail, Rng* rng) {
  if (tail == Tail::kMixed) {
    // One in ten from an instrument three times as noisy.
    const double wide = Chance(0.1, rng) ? 3 : 1;
    return wide * rng->Normal() / std::sqrt(0.9 + 0.1 * 9);
  }
  const double normal = rng->Normal();
  if (tail == Tail::kGaussian) return normal;
  double square = 0;
  for (int k = 0; k < 3; ++k) square += std::pow(rng->Normal(), 2);
  return normal / std::sqrt(square);  // t of 3 degrees of freedom over its deviation
}

/// Errors of all rows, unit deviation; repeats of a pose may share theirs.
Eigen::MatrixXd DrawErrors(const Settings& s, Index rows, Index width, Rng* rng) {
  Eigen::MatrixXd errors(rows, width);
  for (Index row = 0; row < rows; ++row) {
    const bool again = s.repeats_share && s.repeats > 1 && row % s.repeats > 0;
    for (Index k = 0; k < width; ++k) {
      const double drawn = DrawNoise(s.tail, rng);
      errors(row, k) = again ? errors(row - row % s.repeats, k) + kOwnOfRepeat * drawn : drawn;
    }
  }
  if (s.wandering == 0) return errors;
  errors *= std::sqrt(1 - s.wandering);
  const double fresh = std::sqrt(1 - s.wandering_on * s.wandering_on);
  for (Index k = 0; k < width; ++k) {
    double wandered = rng->Normal();
    for (Index row = 0; row < rows; ++row) {
      errors(row, k) += std::sqrt(s.wandering) * wandered;
      wandered = s.wandering_on * wandered + fresh * rng->Normal();
    }
  }
  return errors;
}

/// How far a reading is off that is wrong, in noises.
double DrawOutlier(const Settings& s, Rng* rng) {
  return Chance(s.outliers, rng) ? DrawLogUniform(15, 300, rng) : 0;
}

}  // namespace

Eigen::MatrixXd RandomReadings(const RandomTrial& trial) {
  const Settings& s = trial.settings;
  Rng rng(trial.seed * 15485863 + 3);
  const Physics physics = AllPhysics(trial);
  const std::vector<Isometry3d> poses = TruePoses(trial.built, physics, trial.motion);
  const auto position_read = [&](std::size_t row) -> Vector3d {
    const double scale = ScaleOf(physics.instrument, trial.motion.time[static_cast<Index>(row)]);
    return scale * poses[row].translation();
  };
  const std::vector<int> before = RowsBefore(trial.motion);
  const auto rows = static_cast<Index>(poses.size());
  const bool differences = s.kind == Kind::kAdjacent && !s.shared_pose;
  const Eigen::MatrixXd errors = DrawErrors(s, rows, 6, &rng);
  Eigen::MatrixXd readings(rows, s.kind == Kind::kPose ? 7 : s.kind == Kind::kDistance ? 1 : 3);
  for (Index row = 0; row < rows; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const double outlier = DrawOutlier(s, &rng);
    const Vector3d off = outlier * DrawDirection(&rng);
    if (s.kind == Kind::kDistance) {
      const double wrong = off.x() > 0 ? outlier : -outlier;
      readings(row, 0) = DistanceRead(trial, i, poses[i].translation(), physics.instrument) +
                         s.noise * (errors(row, 0) + wrong);
      continue;
    }
    const Vector3d error = s.noise * (errors.row(row).head<3>().transpose() + off);
    const Vector3d p = position_read(i);
    Vector3d from = Vector3d::Zero();
    if (differences) {
      from = before[i] < 0 ? Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())
                           : position_read(static_cast<std::size_t>(before[i]));
    }
    readings.row(row).head<3>() = (p - from + error).transpose();
    if (s.kind != Kind::kPose) continue;
    const Vector3d turn = s.noise_rotation * errors.row(row).tail<3>().transpose();
    const Eigen::Quaterniond q(Displacement(turn, Vector3d::Zero()).linear() * poses[i].linear());
    readings.row(row).tail<4>() << q.w(), q.x(), q.y(), q.z();
  }
  return readings;
}

}  // namespace dhcal::concealed
