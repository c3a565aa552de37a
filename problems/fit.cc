#include "problems/fit.h"

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "problems/noise.h"

namespace dhcal {
namespace {

constexpr int kMostNoiseRounds = 6;
constexpr double kNoiseAgrees = 0.01;

bool Agree(const Noise& a, const Noise& b) {
  return std::abs(a.sigma / b.sigma - 1) < kNoiseAgrees &&
         std::abs(a.sigma_rotation / b.sigma_rotation - 1) < kNoiseAgrees;
}

/// One scale for all readings cancels in a step whose truncation is relative.
bool DependsOnNoise(const Calibration& c, const SolverOptions& options) {
  bool priors = false;
  for (const Parameter& parameter : c.parameters) priors |= parameter.prior_sigma.has_value();
  return priors || options.truncation.rule == TruncationRule::kNoise ||
         c.measurement->kind().sees_orientation() || c.spec.solver.loss != LossKind::kNone;
}

}  // namespace

SolverOptions OptionsOf(const SolverSpec& spec) {
  SolverOptions options;
  options.kappa = spec.kappa;
  options.truncation = {spec.rule, spec.relative_tolerance};
  options.max_iterations = spec.max_iterations;
  return options;
}

FitSettings SettingsOf(const Calibration& calibration, const Progress& progress) {
  FitSettings settings;
  settings.solver = OptionsOf(calibration.spec.solver);
  settings.noise = InitialNoise(calibration);
  settings.progress = progress;
  return settings;
}

Fit RunFit(const Calibration& calibration, const FitSettings& settings) {
  SolverOptions with_progress = settings.solver;
  with_progress.progress = [&](const IterationRecord& record) {
    if (!settings.progress) return;
    settings.progress(
        {fmt::format("fit, {} step {}", ToString(settings.method), record.iteration)});
  };
  Fit fit;
  fit.method = settings.method;
  fit.noise = settings.noise;
  double seconds = 0;
  const bool robust = calibration.spec.solver.loss != LossKind::kNone;
  fit.problem = std::make_shared<CalibrationProblem>(calibration, fit.noise, /*with_loss=*/false);
  if (settings.start.size() > 0) fit.problem->set_state(settings.start);
  const Eigen::VectorXd first = fit.problem->state();
  for (int round = 0; round < kMostNoiseRounds; ++round) {
    // A robust loss gives readings that are far off no weight, and at the start all of them are:
    // the first round is plain least squares, and the next start from there.
    if (robust && round == 1) {
      const Eigen::VectorXd plain = fit.problem->state();
      fit.problem = std::make_shared<CalibrationProblem>(calibration, fit.noise);
      fit.problem->set_state(plain);
    } else {
      fit.problem->Rewhiten(fit.noise);
      if (!robust) fit.problem->set_state(first);
    }
    fit.summary = MakeSolver(settings.method)->Solve(with_progress, fit.problem.get());
    seconds += fit.summary.seconds;
    fit.summary.seconds = seconds;
    if (!fit.summary.IsSolutionUsable()) break;
    const int rank = fit.summary.trace.empty() ? 0 : fit.summary.trace.back().rank;
    fit.noise_seen = NoiseFromResiduals(calibration, *fit.problem, fit.noise, rank);
    const bool settled =
        !DependsOnNoise(calibration, settings.solver) || Agree(fit.noise_seen, fit.noise);
    fit.noise_settled = settled && (round > 0 || !robust);
    if (fit.noise_settled) break;
    if (round + 1 < kMostNoiseRounds) fit.noise = fit.noise_seen;
  }
  return fit;
}

Fit RunBentFit(const FitSettings& settings, Calibration* c) {
  if (c->effects.empty()) return RunFit(*c, settings);
  // What is held bends the arm already.
  const bool near = settings.start.size() > 0;
  const Eigen::VectorXd nominal =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(c->parameters.size()));
  for (int turn = 0; turn < kBends; ++turn) c->Bend(near ? settings.start : nominal);
  Fit fit = RunFit(*c, settings);
  if (near || c->effect_columns.empty()) return fit;
  FitSettings again = settings;
  // The arm of the second turn differs from the third's by the square of what bends it.
  for (int turn = 0; turn < kBends && fit.summary.IsSolutionUsable(); ++turn) {
    const Fit before = fit;
    c->Bend(before.summary.state);
    again.noise = before.noise_seen;
    again.start = before.summary.state;
    fit = RunFit(*c, again);
    fit.summary.seconds += before.summary.seconds;
  }
  return fit;
}

}  // namespace dhcal
