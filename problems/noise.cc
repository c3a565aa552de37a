#include "problems/noise.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

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

/// Whitened residuals of the fitted readings at the problem's state, as the linear model has them
/// after a step (none: empty). Lengths of rows with a sigma of their own are left out: they tell
/// nothing about the others'. Nothing where the model cannot be evaluated.
std::optional<WhitenedResiduals> Split(const Calibration& c,
                                       const CalibrationProblem& problem,
                                       const Eigen::VectorXd& step = {}) {
  const std::vector<MeasuredCoordinate>& coordinates = c.measurement->kind().coordinates;
  WhitenedResiduals split;
  const auto visit = [&](const TileRows& tile) {
    const Eigen::VectorXd r =
        step.size() > 0 ? Eigen::VectorXd(tile.r() + tile.J() * step) : Eigen::VectorXd(tile.r());
    const std::size_t count = tile.readings.size();
    for (std::size_t k = 0; k < coordinates.size() * count; ++k) {
      const auto reading = static_cast<std::size_t>(tile.readings[k % count]);
      const double value = r[static_cast<Eigen::Index>(k)];
      if (coordinates[k / count].unit == Unit::kRadian) {
        split.rotations.push_back(value);
      } else if (!c.HasOwnSigma(c.readings.fitted[reading].row_idx)) {
        split.lengths.push_back(value);
      }
    }
  };
  if (!problem.rows().Visit(problem.state(), problem.row_noise(), visit)) return std::nullopt;
  return split;
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
      static_cast<double>(c.readings.fitted.size()) * c.measurement->kind().num_coordinates();
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
  source.rotation_given =
      !c.measurement->kind().sees_orientation() || c.spec.measurement.sigma_rotation.has_value();
  source.description = per_row              ? "given per row"
                       : source.sigma_given ? "given"
                                            : "estimated from the residuals";
  std::string others;
  for (const MeasuredCoordinate& coordinate : c.measurement->kind().coordinates) {
    if (coordinate.noise == 1) continue;
    others +=
        fmt::format("{}{} {:.3g}", others.empty() ? "; " : ", ", coordinate.name, coordinate.noise);
  }
  if (!others.empty()) source.description += others + " of it";
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

  CalibrationProblem problem(c, noise, /*with_loss=*/false);
  Linearization linearization;
  if (!Linearize(&problem, &linearization)) return noise;
  const Truncation rule{TruncationRule::kRelative, kRelativeCut};
  const TruncatedSvd svd = Truncate(rule, problem.scales.tolerance, linearization);
  const auto residuals = Split(c, problem, svd.Solve(linearization.b));
  return residuals ? Rescale(c, noise, *residuals, svd.rank) : noise;
}

Noise NoiseFromResiduals(const Calibration& c,
                         const CalibrationProblem& problem,
                         const Noise& noise,
                         int rank) {
  if (SourceOfNoise(c).all_given()) return noise;
  const auto residuals = Split(c, problem);
  return residuals ? Rescale(c, noise, *residuals, rank) : noise;
}

}  // namespace dhcal
