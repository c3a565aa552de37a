#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/solver/linearization.h"
#include "problems/assembly.h"
#include "problems/fit_analysis.h"
#include "problems/prediction.h"

namespace dhcal {
namespace {

/// Share of each fitted reading in its own prediction: the diagonal of the hat matrix, summed over
/// the reading's coordinates. The shares of all readings add up to the rank.
std::vector<double> Leverages(const FitAnalysis& analysis, const CalibrationProblem& problem) {
  const TruncatedSvd& svd = analysis.identifiability.all;
  const Eigen::MatrixXd to_unit =
      svd.scale.asDiagonal() * svd.kept() * svd.s.head(svd.rank).cwiseInverse().asDiagonal();
  std::vector<double> leverages(static_cast<std::size_t>(problem.rows().num_readings()), 0.0);
  problem.rows().Visit(problem.state(), problem.row_noise(), [&](const TileRows& tile) {
    const Eigen::VectorXd of_row = (tile.J() * to_unit).rowwise().squaredNorm();
    const std::size_t count = tile.readings.size();
    for (Eigen::Index k = 0; k < of_row.size(); ++k) {
      const auto i = static_cast<std::size_t>(k) % count;
      leverages[static_cast<std::size_t>(tile.readings[i])] += of_row[k];
    }
  });
  return leverages;
}

/// What the calibrated robot leaves of a reading; the prediction before is filled in apart.
RowResidual DescribeRow(const Calibration& c,
                        const Noise& noise,
                        const Reading& reading,
                        const Comparison& after) {
  RowResidual row;
  row.row_idx = reading.row_idx;
  const Recording& recording = c.recording;
  if (!recording.run_idx.empty()) row.run = recording.run_names[recording.run(reading.row_idx)];
  row.measured = after.measured;
  row.predicted_after = after.predicted;
  row.residual = after.residual;
  double sigma = c.RowSigma(reading.row_idx, noise);
  if (c.spec.measurement.noise == NoiseKind::kSharedPose && reading.previous_idx >= 0) {
    sigma = std::hypot(sigma, c.RowSigma(reading.previous_idx, noise));
  }
  row.standardised = after.residual / sigma;
  const Eigen::Index lengths = c.measurement->kind().num_lengths();
  const Eigen::Index rotations = row.residual.size() - lengths;
  row.standardised.tail(rotations) = row.residual.tail(rotations) / noise.sigma_rotation;
  const std::vector<MeasuredCoordinate>& coordinates = c.measurement->kind().coordinates;
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    row.standardised[static_cast<Eigen::Index>(k)] /= coordinates[k].noise;
  }
  row.length = row.residual.head(lengths).norm();
  row.sigmas = row.standardised.lpNorm<Eigen::Infinity>();
  return row;
}

/// One entry per reading of `readings`, in their order.
std::vector<RowResidual> DescribeReadings(const Calibration& c,
                                          const Noise& noise,
                                          const ReadingRows& readings,
                                          const Eigen::VectorXd& state) {
  std::vector<RowResidual> rows(static_cast<std::size_t>(readings.num_readings()));
  VisitComparisons(readings, state, [&](int k, const Comparison& after) {
    const auto i = static_cast<std::size_t>(k);
    rows[i] = DescribeRow(c, noise, readings.model().readings[i], after);
  });
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(state.size());
  VisitComparisons(readings, start, [&](int k, const Comparison& before) {
    rows[static_cast<std::size_t>(k)].predicted_before = before.predicted;
  });
  return rows;
}

}  // namespace

std::vector<RowResidual> DescribeRows(const Calibration& c,
                                      const FitAnalysis& analysis,
                                      const CalibrationProblem& problem) {
  std::vector<RowResidual> rows =
      DescribeReadings(c, analysis.noise, problem.rows(), problem.state());
  const std::vector<double> leverages = Leverages(analysis, problem);
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].leverage = leverages[k];
  for (const std::vector<Reading>* const others : {&c.readings.test, &c.readings.set_aside}) {
    const ReadingRows other_rows = RowsOf(c, *others);
    for (RowResidual& row : DescribeReadings(c, analysis.noise, other_rows, problem.state())) {
      row.test = c.recording.test(row.row_idx);
      rows.push_back(std::move(row));
    }
  }
  std::sort(rows.begin(), rows.end(), [](const RowResidual& a, const RowResidual& b) {
    return a.row_idx < b.row_idx;
  });
  return rows;
}

}  // namespace dhcal
