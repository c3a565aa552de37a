// A least-squares problem as the solvers see it: one scalar Ceres parameter block per unknown.
#ifndef DHCAL_CORE_SOLVER_ESTIMATION_PROBLEM_H_
#define DHCAL_CORE_SOLVER_ESTIMATION_PROBLEM_H_

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <ceres/evaluation_callback.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>

namespace dhcal {

/// What the solvers need to know of the unknowns besides their derivatives.
struct UnknownScales {
  Eigen::VectorXd tolerance;  // what manufacture leaves open, one sigma; > 0
  Eigen::VectorXd limit;      // a larger correction is no calibration; may be infinite
};

/// Owns a Ceres problem and the state it works on. Not movable: Ceres keeps pointers into it.
struct EstimationProblem {
  EstimationProblem() = default;
  EstimationProblem(const EstimationProblem&) = delete;
  EstimationProblem& operator=(const EstimationProblem&) = delete;

  int num_unknowns() const { return static_cast<int>(state.size()); }
  std::vector<double*> blocks();
  Eigen::VectorXd state_vector() const;
  void set_state(const Eigen::VectorXd& x);

  std::vector<double> state;  // corrections to the start, [rad] or [m]
  UnknownScales scales;
  double kappa_unit = 1.0;  // [m] that a whitened residual of 1 stands for

  // Destroyed in reverse order: the problem before what its blocks point to.
  std::unique_ptr<ceres::EvaluationCallback> cache;
  std::unique_ptr<ceres::LossFunction> loss;
  std::unique_ptr<ceres::Problem> problem;
  std::vector<ceres::ResidualBlockId> readings;  // in the order of the fitted readings
  std::vector<ceres::ResidualBlockId> priors;
};

/// Builds the same problem again. Levenberg-Marquardt needs two: while Ceres iterates on one, the
/// callback linearises the other (Ceres forbids evaluating a problem that is being solved).
using EstimationProblemFactory = std::function<std::unique_ptr<EstimationProblem>()>;

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_ESTIMATION_PROBLEM_H_
