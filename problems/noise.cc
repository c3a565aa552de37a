#include "problems/noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/statistics.h"
#include "core/solver/linearization.h"
#include "core/solver/truncation.h"
#include "problems/assembly.h"

namespace dhcal {
namespace {

// Loose enough that rounding is not taken for a direction.
constexpr double kRelativeCut = 1e-8;

/// Whitened residuals, apart for lengths and rotations.
struct WhitenedResiduals {
  std::vector<double> lengths, rotations;
};

/// Lengths of rows with a sigma of their own are left out: they tell nothing about the others'.
WhitenedResiduals Split(const Calibration& c, const Eigen::VectorXd& residuals) {
  const int coordinates = NumCoordinates(c.spec.measurement.kind);
  WhitenedResiduals split;
  for (Eigen::Index k = 0; k < residuals.size(); ++k) {
    const Reading& reading = c.readings.fitted[static_cast<std::size_t>(k / coordinates)];
    if (k % coordinates >= 3) {
      split.rotations.push_back(residuals[k]);
    } else if (!c.HasOwnSigma(reading.row_idx)) {
      split.lengths.push_back(residuals[k]);
    }
  }
  return split;
}

/// Whitened residuals of the linear model after a step.
Eigen::VectorXd ResidualsAfter(EstimationProblem* problem, const Eigen::VectorXd& step) {
  std::vector<double> residuals;
  ForEachChunk(problem,
               problem->readings,
               [&](int /*first*/, const Eigen::VectorXd& r, const Eigen::MatrixXd& J) {
                 const Eigen::VectorXd after = r + J * step;
                 residuals.insert(residuals.end(), after.begin(), after.end());
               });
  return Eigen::Map<Eigen::VectorXd>(residuals.data(), static_cast<Eigen::Index>(residuals.size()));
}

/// Standard deviation of values that `share` of the freedom is left to.
double Scale(const std::vector<double>& values, double share, bool robust) {
  if (robust) return RobustScale(values) / std::sqrt(share);
  double square = 0;
  for (const double value : values) square += value * value;
  return std::sqrt(square / (static_cast<double>(values.size()) * share));
}

Noise Rescale(const Calibration& c, const Noise& noise, const WhitenedResiduals& r, int rank) {
  const NoiseSource source = SourceOfNoise(c);
  const auto count =
      static_cast<double>(c.readings.fitted.size()) * NumCoordinates(c.spec.measurement.kind);
  const double share = std::max(1.0 - rank / count, 1.0 / count);
  const bool robust = c.spec.solver.loss != LossKind::kNone;
  Noise result = noise;
  if (!source.sigma_given && !r.lengths.empty()) {
    result.sigma = std::max(noise.sigma * Scale(r.lengths, share, robust), kFinestSigma);
  }
  if (!source.rotation_given) {
    result.sigma_rotation =
        std::max(noise.sigma_rotation * Scale(r.rotations, share, robust), kFinestSigmaRotation);
  }
  return result;
}

}  // namespace

NoiseSource SourceOfNoise(const Calibration& c) {
  // A row that gives no reading needs no sigma; with shared noise the row before counts, too.
  const auto own_sigma = [&](const Reading& reading) {
    return c.HasOwnSigma(reading.row_idx) &&
           (c.spec.measurement.noise != NoiseKind::kSharedPose || reading.previous_idx < 0 ||
            c.HasOwnSigma(reading.previous_idx));
  };
  const bool per_row = c.recording.sigma.size() > 0 &&
                       std::all_of(c.readings.fitted.begin(), c.readings.fitted.end(), own_sigma) &&
                       std::all_of(c.readings.test.begin(), c.readings.test.end(), own_sigma);
  NoiseSource source;
  source.per_row = per_row;
  source.sigma_given = per_row || c.spec.measurement.sigma.has_value();
  source.rotation_given = c.spec.measurement.kind != MeasurementKind::kPose ||
                          c.spec.measurement.sigma_rotation.has_value();
  source.description = per_row              ? "given per row"
                       : source.sigma_given ? "given"
                                            : "estimated from the residuals";
  return source;
}

Noise InitialNoise(const Calibration& c) {
  const NoiseSource source = SourceOfNoise(c);
  Noise noise;
  if (c.recording.sigma.size() > 0) {
    std::vector<double> known;
    for (const double sigma : c.recording.sigma) {
      if (std::isfinite(sigma)) known.push_back(sigma);
    }
    if (!known.empty()) noise.sigma = Median(known);
  }
  // The value for blank cells; where none is blank, rows speak for themselves.
  if (!source.per_row) noise.sigma = c.spec.measurement.sigma.value_or(noise.sigma);
  noise.sigma_rotation = c.spec.measurement.sigma_rotation.value_or(noise.sigma_rotation);
  if (source.all_given()) return noise;

  const auto problem = BuildProblem(c, noise, /*with_loss=*/false);
  Linearization linearization;
  if (!Linearize(problem.get(), &linearization)) return noise;
  const Truncation rule{TruncationRule::kRelative, kRelativeCut};
  const TruncatedSvd svd = Truncate(rule, problem->scales.tolerance, linearization);
  const Eigen::VectorXd step = svd.Solve(linearization.b);
  return Rescale(c, noise, Split(c, ResidualsAfter(problem.get(), step)), svd.rank);
}

Noise NoiseFromResiduals(const Calibration& c,
                         const Noise& noise,
                         const Eigen::VectorXd& state,
                         int rank) {
  if (SourceOfNoise(c).all_given()) return noise;
  const auto problem = BuildProblem(c, noise, /*with_loss=*/false);
  problem->set_state(state);
  Eigen::VectorXd residuals;
  if (!EvaluateReadings(problem.get(), &residuals)) return noise;
  return Rescale(c, noise, Split(c, residuals), rank);
}

}  // namespace dhcal
