// The one callback through which both solvers report and stop.
#ifndef DHCAL_CORE_SOLVER_TRACE_CALLBACK_H_
#define DHCAL_CORE_SOLVER_TRACE_CALLBACK_H_

#include <functional>
#include <optional>
#include <vector>

#include <ceres/iteration_callback.h>

#include "core/math/truncated_svd.h"
#include "core/model/result.h"
#include "core/solver/estimation_problem.h"
#include "core/solver/linearization.h"
#include "core/solver/truncation.h"

namespace dhcal {

/// At every state that a solver accepts it linearises the problem and truncates the SVD. When the
/// next step has been taken it notes that linearisation's rank and ||J drho - dx|| of the step
/// (English et al. 2004, eq. 13), and if the norm is at or below kappa the solver is told to stop:
/// so the step on which kappa holds is still applied, as in the paper's Table III.
class TraceCallback : public ceres::IterationCallback {
 public:
  /// `problem` must outlive the callback; its state is what a solver has accepted last.
  TraceCallback(EstimationProblem* problem,
                Truncation truncation,
                double kappa,
                std::function<void(const IterationRecord&)> progress);

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override;

  /// Notes that no step was taken from here, so that a trace has at least one record.
  void NoteNoStep();

  const std::vector<IterationRecord>& trace() const { return trace_; }
  bool kappa_holds() const { return kappa_holds_; }
  bool failed() const { return failed_; }

  /// At the latest accepted state.
  const Linearization& linearization() const { return linearization_; }
  const TruncatedSvd& svd() const { return svd_; }
  /// Of the latest completed step; empty before.
  const std::optional<TruncatedSvd>& svd_of_last_step() const { return svd_of_last_step_; }
  /// The truncated step from the latest accepted state.
  Eigen::VectorXd Step() const { return svd_.Solve(linearization_.b); }

 private:
  bool LinearizeHere();
  void CompleteRecord(const ceres::IterationSummary& summary);

  EstimationProblem* problem_;
  Truncation truncation_;
  double kappa_;
  std::function<void(const IterationRecord&)> progress_;

  Linearization linearization_;
  TruncatedSvd svd_;
  std::optional<TruncatedSvd> svd_of_last_step_;
  Eigen::VectorXd state_;  // where linearization_ belongs
  std::vector<IterationRecord> trace_;
  bool kappa_holds_ = false;
  bool failed_ = false;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_TRACE_CALLBACK_H_
