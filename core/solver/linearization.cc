#include "core/solver/linearization.h"

#include <cmath>
#include <vector>

#include "core/math/tsqr.h"

namespace dhcal {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Reads blocks of the prepared probe straight into the reduction; no matrix of the whole problem
/// is made. Adds their cost.
bool Reduce(const ceres::Problem& probe,
            const std::vector<ceres::ResidualBlockId>& blocks,
            Tsqr* tsqr,
            double* cost) {
  const Eigen::Index n = tsqr->num_cols() - 1;
  Eigen::VectorXd r;
  RowMajor J;
  Eigen::MatrixXd rows;
  for (const ceres::ResidualBlockId id : blocks) {
    const int height = probe.GetCostFunctionForResidualBlock(id)->num_residuals();
    r.resize(height);
    J.resize(height, n);
    double* jacobian = J.data();
    double of_block = 0;
    if (!probe.EvaluateResidualBlockAssumingParametersUnchanged(
            id, /*apply_loss_function=*/true, &of_block, r.data(), &jacobian)) {
      return false;
    }
    if (!r.allFinite() || !J.allFinite()) return false;
    *cost += of_block;
    rows.resize(height, n + 1);
    rows << J, -r;
    tsqr->Add(rows);
  }
  return true;
}

}  // namespace

Linearization FromTriangle(const Eigen::MatrixXd& triangle) {
  const Eigen::Index n = triangle.cols() - 1;
  Linearization linearization{triangle.topLeftCorner(n, n),
                              triangle.col(n).head(n),
                              std::abs(triangle(n, n)),
                              0.5 * triangle.col(n).squaredNorm()};
  return linearization;
}

bool Linearize(EstimationProblem* problem, Linearization* all, Linearization* readings) {
  const ceres::Problem& probe = *problem->PreparedProbe();
  Tsqr tsqr(problem->num_unknowns() + 1);
  double cost = 0;
  if (!Reduce(probe, problem->readings(), &tsqr, &cost)) return false;
  if (readings != nullptr) {
    *readings = FromTriangle(tsqr.R());
    readings->cost = cost;
  }
  if (!Reduce(probe, problem->priors(), &tsqr, &cost)) return false;
  *all = FromTriangle(tsqr.R());
  all->cost = cost;
  return true;
}

}  // namespace dhcal
