#include "core/solver/estimation_problem.h"

#include <utility>

#include <glog/logging.h>

namespace dhcal {

/// Prepares the blocks for where a parameter block stands.
class EstimationProblem::StateCallback final : public ceres::EvaluationCallback {
 public:
  StateCallback(const Preparation* prepare, const Eigen::VectorXd* state)
      : prepare_(prepare), state_(state) {}
  void PrepareForEvaluation(bool /*evaluate_jacobians*/, bool /*new_evaluation_point*/) override {
    // Ceres announces a new point also where it evaluates the same one again.
    if (*prepare_) (*prepare_)(*state_);
  }

 private:
  const Preparation* prepare_;
  const Eigen::VectorXd* state_;
};

EstimationProblem::EstimationProblem(int num_unknowns, Preparation prepare)
    : prepare_(std::move(prepare)),
      state_(Eigen::VectorXd::Zero(num_unknowns)),
      probe_state_(Eigen::VectorXd::Zero(num_unknowns)),
      callback_(std::make_unique<StateCallback>(&prepare_, &state_)),
      probe_callback_(std::make_unique<StateCallback>(&prepare_, &probe_state_)) {
  const auto make = [&](ceres::EvaluationCallback* callback, Eigen::VectorXd* state) {
    ceres::Problem::Options options;
    options.evaluation_callback = callback;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    auto problem = std::make_unique<ceres::Problem>(options);
    problem->AddParameterBlock(state->data(), num_unknowns);
    return problem;
  };
  problem_ = make(callback_.get(), &state_);
  probe_ = make(probe_callback_.get(), &probe_state_);
}

ceres::ResidualBlockId EstimationProblem::Add(std::unique_ptr<ceres::CostFunction> block,
                                              ceres::LossFunction* loss) {
  problem_->AddResidualBlock(block.get(), loss, state_.data());
  const auto id = probe_->AddResidualBlock(block.get(), loss, probe_state_.data());
  blocks_.push_back(std::move(block));
  return id;
}

void EstimationProblem::AddReading(std::unique_ptr<ceres::CostFunction> block,
                                   ceres::LossFunction* loss) {
  readings_.push_back(Add(std::move(block), loss));
}

void EstimationProblem::AddPrior(std::unique_ptr<ceres::CostFunction> block) {
  priors_.push_back(Add(std::move(block), nullptr));
}

void EstimationProblem::set_state(const Eigen::VectorXd& x) {
  CHECK_EQ(x.size(), state_.size());
  state_ = x;
}

ceres::Problem* EstimationProblem::PreparedProbe() {
  probe_state_ = state_;
  probe_callback_->PrepareForEvaluation(true, true);
  return probe_.get();
}

}  // namespace dhcal
