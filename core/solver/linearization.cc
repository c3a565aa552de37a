#include "core/solver/linearization.h"

#include <algorithm>

#include <ceres/crs_matrix.h>

#include "core/math/tsqr.h"

namespace dhcal {
namespace {

// Bounds the dense rows held at a time; smaller chunks would pay more often for what Ceres does per
// evaluation over all blocks of the problem.
constexpr std::size_t kBlocksPerChunk = 4096;

Eigen::MatrixXd Dense(const ceres::CRSMatrix& sparse) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row) {
    const auto begin = static_cast<std::size_t>(sparse.rows[static_cast<std::size_t>(row)]);
    const auto end = static_cast<std::size_t>(sparse.rows[static_cast<std::size_t>(row) + 1]);
    for (std::size_t k = begin; k < end; ++k) dense(row, sparse.cols[k]) = sparse.values[k];
  }
  return dense;
}

bool AddTo(EstimationProblem* problem,
           const std::vector<ceres::ResidualBlockId>& blocks,
           Tsqr* tsqr) {
  return ForEachChunk(problem,
                      blocks,
                      [&](int /*first_block*/, const Eigen::VectorXd& r, const Eigen::MatrixXd& J) {
                        Eigen::MatrixXd rows(J.rows(), J.cols() + 1);
                        rows << J, -r;
                        tsqr->Add(rows);
                      });
}

}  // namespace

bool ForEachChunk(EstimationProblem* problem,
                  const std::vector<ceres::ResidualBlockId>& blocks,
                  const RowVisitor& visit) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = problem->blocks();
  for (std::size_t first = 0; first < blocks.size(); first += kBlocksPerChunk) {
    const std::size_t last = std::min(first + kBlocksPerChunk, blocks.size());
    options.residual_blocks.assign(blocks.begin() + static_cast<std::ptrdiff_t>(first),
                                   blocks.begin() + static_cast<std::ptrdiff_t>(last));
    std::vector<double> residuals;
    ceres::CRSMatrix jacobian;
    if (!problem->problem->Evaluate(options, nullptr, &residuals, nullptr, &jacobian)) return false;
    const Eigen::Map<const Eigen::VectorXd> r(residuals.data(),
                                              static_cast<Eigen::Index>(residuals.size()));
    const Eigen::MatrixXd J = Dense(jacobian);
    if (!r.allFinite() || !J.allFinite()) return false;
    visit(static_cast<int>(first), r, J);
  }
  return true;
}

Linearization FromTriangle(const Eigen::MatrixXd& triangle, int num_residuals) {
  const Eigen::Index n = triangle.cols() - 1;
  return {triangle.topLeftCorner(n, n),
          triangle.col(n).head(n),
          std::abs(triangle(n, n)),
          num_residuals};
}

bool Linearize(EstimationProblem* problem, Linearization* all, Linearization* readings) {
  Tsqr tsqr(problem->num_unknowns() + 1);
  if (!AddTo(problem, problem->readings, &tsqr)) return false;
  if (readings != nullptr) *readings = FromTriangle(tsqr.R(), tsqr.num_rows());
  if (!AddTo(problem, problem->priors, &tsqr)) return false;
  *all = FromTriangle(tsqr.R(), tsqr.num_rows());
  return true;
}

bool EvaluateReadings(EstimationProblem* problem, Eigen::VectorXd* residuals) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = problem->blocks();
  options.residual_blocks = problem->readings;
  std::vector<double> values;
  if (!problem->problem->Evaluate(options, nullptr, &values, nullptr, nullptr)) return false;
  *residuals =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return residuals->allFinite();
}

}  // namespace dhcal
