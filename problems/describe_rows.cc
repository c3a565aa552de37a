#include <algorithm>
#include <cmath>

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

RowResidual DescribeRow(const Calibration& c,
                        const FitAnalysis& analysis,
                        const Eigen::VectorXd& state,
                        const Reading& reading) {
  const Comparison after = Compare(c, state, reading);
  RowResidual row;
  row.row_idx = reading.row_idx;
  const Recording& recording = c.recording;
  if (!recording.run_idx.empty()) row.run = recording.run_names[recording.run(reading.row_idx)];
  row.measured = after.measured;
  row.predicted_before = Compare(c, Eigen::VectorXd::Zero(state.size()), reading).predicted;
  row.predicted_after = after.predicted;
  row.residual = after.residual;
  double sigma = c.RowSigma(reading.row_idx, analysis.noise);
  if (c.spec.measurement.noise == NoiseKind::kSharedPose && reading.previous_idx >= 0) {
    sigma = std::hypot(sigma, c.RowSigma(reading.previous_idx, analysis.noise));
  }
  row.standardised = after.residual / sigma;
  const Eigen::Index lengths = c.measurement->kind().num_lengths();
  const Eigen::Index rotations = row.residual.size() - lengths;
  row.standardised.tail(rotations) = row.residual.tail(rotations) / analysis.noise.sigma_rotation;
  row.length = row.residual.head(lengths).norm();
  row.sigmas = row.standardised.lpNorm<Eigen::Infinity>();
  return row;
}

}  // namespace

std::vector<RowResidual> DescribeRows(const Calibration& c,
                                      const FitAnalysis& analysis,
                                      const CalibrationProblem& problem) {
  const Eigen::VectorXd& state = problem.state();
  const std::vector<double> leverages = Leverages(analysis, problem);
  std::vector<RowResidual> rows;
  for (std::size_t k = 0; k < c.readings.fitted.size(); ++k) {
    rows.push_back(DescribeRow(c, analysis, state, c.readings.fitted[k]));
    rows.back().leverage = leverages[k];
  }
  for (const Reading& reading : c.readings.test) {
    rows.push_back(DescribeRow(c, analysis, state, reading));
    rows.back().test = true;
  }
  std::sort(rows.begin(), rows.end(), [](const RowResidual& a, const RowResidual& b) {
    return a.row_idx < b.row_idx;
  });
  return rows;
}

}  // namespace dhcal
