// The linear model of a problem at its state, as Ceres evaluates it, reduced to a triangle.
#ifndef DHCAL_CORE_SOLVER_LINEARIZATION_H_
#define DHCAL_CORE_SOLVER_LINEARIZATION_H_

#include <Eigen/Core>

#include "core/solver/estimation_problem.h"

namespace dhcal {

/// min over dx of ||R dx - b||^2 + outside^2, where [R, b] stands for all rows of [J, -r]: whitened
/// Jacobian and dx = -(predicted - measured), the paper's Delta x. With robust losses the rows are
/// Ceres' corrected ones. Made by Tsqr.
struct Linearization {
  Eigen::MatrixXd R;   // num_unknowns x num_unknowns upper triangle
  Eigen::VectorXd b;   // num_unknowns
  double outside = 0;  // norm of the part of -r that no step reaches
  double cost = 0;     // 1/2 sum of rho(||r||^2) at the state, Ceres' own
};

/// Splits an upper triangle of [J, -r]; the cost is that without a loss.
Linearization FromTriangle(const Eigen::MatrixXd& triangle);

/// Linearises readings and priors at the problem's state, block by block, and gives the readings
/// alone where wanted; false when Ceres cannot evaluate.
bool Linearize(EstimationProblem* problem, Linearization* all, Linearization* readings = nullptr);

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_LINEARIZATION_H_
