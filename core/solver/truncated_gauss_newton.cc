#include "core/solver/truncated_gauss_newton.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <ceres/iteration_callback.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include "core/solver/trace_callback.h"
#include "core/solver/truncated_subspace.h"

namespace dhcal {
namespace {

/// How the loop ended; kNotRun = it goes on.
Termination Decide(const SolverOptions& options,
                   const TraceCallback& callback,
                   double previous_cost,
                   std::string* message) {
  const IterationRecord& last = callback.trace().back();
  if (callback.kappa_holds()) {
    *message = fmt::format("Kappa test passed: ||J drho - dx|| = {:.4e} m <= kappa = {:.4e} m.",
                           last.kappa_norm,
                           options.kappa);
    return Termination::kKappa;
  }
  const double change = std::abs(previous_cost - last.cost);
  const double allowed = options.cost_tolerance * (1.0 + last.cost);
  if (last.step_norm <= options.step_tolerance && change <= allowed) {
    *message = fmt::format(
        "Step and cost change are small: step {:.2e} <= {:.2e} tolerances, cost change {:.2e} <= "
        "{:.2e}; ||J drho - dx|| = {:.4e} m stays above kappa = {:.1e} m.",
        last.step_norm,
        options.step_tolerance,
        change,
        allowed,
        last.kappa_norm,
        options.kappa);
    return Termination::kSmallChange;
  }
  if (last.iteration >= options.max_iterations) {
    *message = fmt::format(
        "Iteration limit: {} of {} iterations done; last step {:.2e} tolerances, ||J drho - dx|| = "
        "{:.4e} m.",
        last.iteration,
        options.max_iterations,
        last.step_norm,
        last.kappa_norm);
    return Termination::kIterationLimit;
  }
  return Termination::kNotRun;
}

std::string NoBetterStep(const TraceCallback& callback, const Eigen::VectorXd& tolerance) {
  if (callback.svd().rank == 0) return "No direction is determined by the readings: nothing to do.";
  return fmt::format(
      "No step lowers the cost of {:.6g} any more; the next would have been {:.2e} "
      "tolerances long.",
      callback.linearization().cost,
      callback.Step().cwiseQuotient(tolerance).norm());
}

/// Takes one step at a time and notes that it was taken.
class Stepper {
 public:
  explicit Stepper(EstimationProblem* problem) : problem_(problem) {}
  virtual ~Stepper() = default;
  /// From where `callback` has linearised last; false where no step lowers the cost.
  virtual bool Step(TraceCallback* callback) = 0;

 protected:
  EstimationProblem* problem_;
};

/// The paper's: the whole step, whatever comes of it.
class PlainStepper final : public Stepper {
 public:
  using Stepper::Stepper;
  bool Step(TraceCallback* callback) override {
    problem_->set_state(problem_->state() + callback->Step());  // steps 3 and 5
    ceres::IterationSummary at;
    at.iteration = 1;
    at.step_is_successful = true;
    at.cost = kNotSet;  // known once the callback has linearised at the new state
    (*callback)(at);    // steps 6 to 8, and the test of step 4 on the step just applied
    return true;
  }
};

/// Ends a solve with the first step that is accepted; remembers the damping for the next.
class StopAfterStep final : public ceres::IterationCallback {
 public:
  StopAfterStep(int most_rejections, bool step_is_small)
      : most_rejections_(most_rejections), step_is_small_(step_is_small) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    radius_ = summary.trust_region_radius;
    if (summary.iteration == 0) return ceres::SOLVER_CONTINUE;
    // A tiny step that is refused is refused for rounding: a shorter one would be, too.
    const bool goes_on = !summary.step_is_successful && ++rejections_ < most_rejections_;
    return goes_on && !step_is_small_ ? ceres::SOLVER_CONTINUE
                                      : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }
  double radius() const { return radius_; }

 private:
  int most_rejections_;
  bool step_is_small_;
  int rejections_ = 0;
  double radius_ = 0;
};

/// Ceres' own step in the kept subspace.
class DampedStepper final : public Stepper {
 public:
  DampedStepper(EstimationProblem* problem, double step_tolerance)
      : Stepper(problem), step_tolerance_(step_tolerance) {}

  bool Step(TraceCallback* callback) override {
    const TruncatedSvd& svd = callback->svd();
    if (svd.rank == 0) return false;
    const double length = callback->Step().cwiseQuotient(problem_->scales.tolerance).norm();
    StopAfterStep stop(kMostRejections, length <= step_tolerance_);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = kMostRejections;
    options.initial_trust_region_radius = radius_;
    // When to stop is decided by whoever asks for steps.
    options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 0;
    options.update_state_every_iteration = true;
    options.logging_type = ceres::SILENT;
    options.callbacks = {callback, &stop};
    problem_->problem()->SetManifold(problem_->block(), new TruncatedSubspace(svd));
    const std::size_t steps_before = callback->trace().size();
    ceres::Solver::Summary summary;
    ceres::Solve(options, problem_->problem(), &summary);
    problem_->problem()->SetManifold(problem_->block(), nullptr);
    radius_ = std::max(stop.radius(), kSmallestRadius);
    return callback->trace().size() > steps_before;
  }

 private:
  // Ceres damps by 1 / radius of a column's square: this leaves twelve digits of the step.
  static constexpr double kFirstRadius = 1e12;
  static constexpr double kSmallestRadius = 1e-3;
  // Each rejection divides the radius by 2, 4, 8 ...: these many lead from the first radius to one
  // where the step is a short way downhill.
  static constexpr int kMostRejections = 12;

  double step_tolerance_;
  double radius_ = kFirstRadius;
};

std::unique_ptr<Stepper> MakeStepper(const SolverOptions& options, EstimationProblem* problem) {
  if (options.truncation.rule == TruncationRule::kPaper) {
    return std::make_unique<PlainStepper>(problem);
  }
  return std::make_unique<DampedStepper>(problem, options.step_tolerance);
}

}  // namespace

SolverSummary TruncatedGaussNewton::DoSolve(const SolverOptions& options,
                                            EstimationProblem* problem) const {
  SolverSummary summary;
  TraceCallback callback(problem, options.truncation, options.kappa, options.progress);
  callback(ceres::IterationSummary());  // steps 1 and 2: predict and linearise at the start
  if (callback.failed()) {
    summary.termination = Termination::kFailed;
    summary.message = "The model cannot be evaluated at the start.";
    summary.state = problem->state();
    return summary;
  }
  summary.initial_cost = callback.linearization().cost;
  const std::unique_ptr<Stepper> stepper = MakeStepper(options, problem);
  while (summary.termination == Termination::kNotRun) {
    const double previous_cost = callback.linearization().cost;
    const bool stepped = stepper->Step(&callback);
    if (callback.failed()) {
      summary.termination = Termination::kDiverged;
      summary.message =
          fmt::format("Diverged: after step {} the model cannot be evaluated any more.",
                      callback.trace().size());
    } else if (!stepped) {
      if (callback.trace().empty()) callback.NoteNoStep();
      summary.termination = Termination::kSmallChange;
      summary.message = NoBetterStep(callback, problem->scales.tolerance);
    } else {
      summary.termination = Decide(options, callback, previous_cost, &summary.message);
    }
  }
  summary.state = problem->state();
  summary.trace = callback.trace();
  summary.svd_of_last_step = callback.svd_of_last_step();
  summary.final_cost = callback.failed() ? kNotSet : callback.linearization().cost;
  return summary;
}

}  // namespace dhcal
