// A least-squares problem as the solvers see it: one dense Ceres parameter block of all unknowns.
#ifndef DHCAL_CORE_SOLVER_ESTIMATION_PROBLEM_H_
#define DHCAL_CORE_SOLVER_ESTIMATION_PROBLEM_H_

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>

namespace dhcal {

/// What the solvers need to know of the unknowns besides their derivatives.
struct UnknownScales {
  Eigen::VectorXd tolerance;  // what manufacture leaves open, one sigma; > 0
  Eigen::VectorXd limit;      // a larger correction is no calibration; may be infinite
};

/// The same residual blocks in two Ceres problems. On `problem` a solver iterates, with a manifold
/// perhaps; Ceres forbids evaluating it meanwhile, so that `probe` is what is linearised, at any
/// state and in all unknowns. What the blocks share (poses) is prepared for a state once, whichever
/// of the two asks.
class EstimationProblem {
 public:
  /// Prepares all blocks for evaluation at a state; the same state again must cost nothing.
  using Preparation = std::function<void(const Eigen::VectorXd& x)>;

  explicit EstimationProblem(int num_unknowns, Preparation prepare = {});
  virtual ~EstimationProblem() = default;
  // Not movable: Ceres keeps pointers into it.
  EstimationProblem(const EstimationProblem&) = delete;
  EstimationProblem& operator=(const EstimationProblem&) = delete;

  int num_unknowns() const { return static_cast<int>(state_.size()); }

  /// Blocks of num_unknowns() parameters each. `loss` (may be null) must outlive the problem.
  void AddReading(std::unique_ptr<ceres::CostFunction> block, ceres::LossFunction* loss);
  void AddPrior(std::unique_ptr<ceres::CostFunction> block);

  const Eigen::VectorXd& state() const { return state_; }  // corrections to the start, [rad] or [m]
  void set_state(const Eigen::VectorXd& x);

  ceres::Problem* problem() { return problem_.get(); }
  double* block() { return state_.data(); }

  /// Residual blocks of the probe, in the order in which they were added.
  const std::vector<ceres::ResidualBlockId>& readings() const { return readings_; }
  const std::vector<ceres::ResidualBlockId>& priors() const { return priors_; }
  /// The probe, moved to the state and prepared.
  ceres::Problem* PreparedProbe();
  double* probe_block() { return probe_state_.data(); }

  UnknownScales scales;
  double kappa_unit = 1.0;  // [m] that a whitened residual of 1 stands for

 private:
  class StateCallback;

  ceres::ResidualBlockId Add(std::unique_ptr<ceres::CostFunction> block, ceres::LossFunction* loss);

  Preparation prepare_;
  Eigen::VectorXd state_, probe_state_;
  // Destroyed in reverse order: the problems before what their blocks point to.
  std::unique_ptr<ceres::EvaluationCallback> callback_, probe_callback_;
  std::vector<std::unique_ptr<ceres::CostFunction>> blocks_;
  std::unique_ptr<ceres::Problem> problem_, probe_;
  std::vector<ceres::ResidualBlockId> readings_, priors_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_ESTIMATION_PROBLEM_H_
