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
std::vector<double> Leverages(const Calibration& c,
                              const FitAnalysis& analysis,
                              const Eigen::VectorXd& state) {
  const TruncatedSvd& svd = analysis.identifiability.all;
  const Eigen::MatrixXd to_unit =
      svd.scale.asDiagonal() * svd.kept() * svd.s.head(svd.rank).cwiseInverse().asDiagonal();
  const auto problem = BuildProblem(c, analysis.noise);
  problem->set_state(state);
  const int coordinates = NumCoordinates(c.spec.measurement.kind);
  std::vector<double> leverages(problem->readings.size(), 0.0);
  ForEachChunk(problem.get(),
               problem->readings,
               [&](int first, const Eigen::VectorXd& /*r*/, const Eigen::MatrixXd& J) {
                 const Eigen::VectorXd of_row = (J * to_unit).rowwise().squaredNorm();
                 for (Eigen::Index k = 0; k < of_row.size(); ++k) {
                   leverages[static_cast<std::size_t>(first + k / coordinates)] += of_row[k];
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
  if (c.spec.measurement.kind == MeasurementKind::kAdjacentPosition &&
      c.spec.measurement.noise == NoiseKind::kSharedPose) {
    sigma = std::hypot(sigma, c.RowSigma(reading.previous_idx, analysis.noise));
  }
  row.standardised = after.residual / sigma;
  if (row.residual.size() == 6) {
    row.standardised.tail<3>() = row.residual.tail<3>() / analysis.noise.sigma_rotation;
  }
  row.length = row.residual.head(std::min<Eigen::Index>(row.residual.size(), 3)).norm();
  row.sigmas = row.standardised.lpNorm<Eigen::Infinity>();
  return row;
}

}  // namespace

std::vector<RowResidual> DescribeRows(const Calibration& c,
                                      const FitAnalysis& analysis,
                                      const Eigen::VectorXd& state) {
  const std::vector<double> leverages = Leverages(c, analysis, state);
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
