#include "core/solver/trace_callback.h"

#include <cmath>
#include <utility>

namespace dhcal {

TraceCallback::TraceCallback(EstimationProblem* problem,
                             Truncation truncation,
                             double kappa,
                             std::function<void(const IterationRecord&)> progress)
    : problem_(problem), truncation_(truncation), kappa_(kappa), progress_(std::move(progress)) {}

ceres::CallbackReturnType TraceCallback::operator()(const ceres::IterationSummary& summary) {
  if (summary.iteration > 0) {
    // A rejected step leaves the state, and with it the linearisation, where they were.
    if (!summary.step_is_successful) return ceres::SOLVER_CONTINUE;
    CompleteRecord(summary);
  } else if (state_.size() > 0 && state_ == problem_->state()) {
    return ceres::SOLVER_CONTINUE;  // a further solve starts where the last one ended
  }
  const bool kappa_held = !trace_.empty() && trace_.back().kappa_norm <= kappa_;
  if (!LinearizeHere()) {
    failed_ = true;
    return ceres::SOLVER_ABORT;
  }
  if (!trace_.empty() && std::isnan(trace_.back().cost)) trace_.back().cost = linearization_.cost;
  if (!trace_.empty() && progress_) progress_(trace_.back());
  kappa_holds_ = kappa_held;
  return kappa_held ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
}

void TraceCallback::NoteNoStep() {
  ceres::IterationSummary here;
  here.cost = linearization_.cost;
  CompleteRecord(here);
  kappa_holds_ = trace_.back().kappa_norm <= kappa_;
}

void TraceCallback::CompleteRecord(const ceres::IterationSummary& summary) {
  const Eigen::VectorXd& now = problem_->state();
  IterationRecord record;
  record.iteration = static_cast<int>(trace_.size()) + 1;
  record.cost = summary.cost;
  // Of the step that was taken: Gauss-Newton's is the truncated one, a damped one leaves more.
  const Eigen::VectorXd left = linearization_.R * (now - state_) - linearization_.b;
  record.kappa_norm = std::hypot(left.norm(), linearization_.outside) * problem_->kappa_unit;
  record.rank = svd_.rank;
  record.step_norm = (now - state_).cwiseQuotient(problem_->scales.tolerance).norm();
  trace_.push_back(record);
  svd_of_last_step_ = svd_;
}

bool TraceCallback::LinearizeHere() {
  if (!Linearize(problem_, &linearization_)) return false;
  state_ = problem_->state();
  svd_ = Truncate(truncation_, problem_->scales.tolerance, linearization_);
  return true;
}

}  // namespace dhcal
