// The linear model of a problem at its state, as Ceres evaluates it, reduced to a triangle.
#ifndef DHCAL_CORE_SOLVER_LINEARIZATION_H_
#define DHCAL_CORE_SOLVER_LINEARIZATION_H_

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "core/solver/estimation_problem.h"

namespace dhcal {

/// min over dx of ||R dx - b||^2 + outside^2, where [R, b] stands for all rows of [J, -r]: whitened
/// Jacobian and dx = -(predicted - measured), the paper's Delta x. Made by Tsqr.
struct Linearization {
  Eigen::MatrixXd R;   // num_unknowns x num_unknowns upper triangle
  Eigen::VectorXd b;   // num_unknowns
  double outside = 0;  // norm of the part of -r that no step reaches
  int num_residuals = 0;

  /// 1/2 ||r||^2 at the state.
  double cost() const { return 0.5 * (b.squaredNorm() + outside * outside); }
};

/// Rows of a block of residuals: whitened residuals r and Jacobian J (dense).
using RowVisitor =
    std::function<void(int first_block, const Eigen::VectorXd& r, const Eigen::MatrixXd& J)>;

/// Evaluates `blocks` in chunks of bounded size and hands each to `visit`; with robust losses the
/// rows are Ceres' corrected ones. Returns false when Ceres cannot evaluate at the state.
bool ForEachChunk(EstimationProblem* problem,
                  const std::vector<ceres::ResidualBlockId>& blocks,
                  const RowVisitor& visit);

/// Splits an upper triangle of [J, -r].
Linearization FromTriangle(const Eigen::MatrixXd& triangle, int num_residuals);

/// Linearises readings and priors, and gives the readings alone where wanted; false when Ceres
/// cannot evaluate.
bool Linearize(EstimationProblem* problem, Linearization* all, Linearization* readings = nullptr);

/// Whitened residuals of the readings at the state, without derivatives.
bool EvaluateReadings(EstimationProblem* problem, Eigen::VectorXd* residuals);

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_LINEARIZATION_H_
