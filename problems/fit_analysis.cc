#include "problems/fit_analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/analysis/ceres_covariance.h"
#include "core/analysis/null_space.h"
#include "core/math/statistics.h"
#include "core/solver/linearization.h"
#include "problems/assembly.h"
#include "problems/describe_parameters.h"
#include "problems/noise.h"
#include "problems/prediction.h"

namespace dhcal {
namespace {

/// What a parameter that ran away says of the run.
std::string RunawayWords(const Calibration& c, const Fit& fit) {
  const SolverSummary& summary = fit.summary;
  const Parameter& p = c.parameters[static_cast<std::size_t>(summary.beyond_limit)];
  const bool noise_rule = c.spec.solver.rule == TruncationRule::kNoise &&
                          fit.method != SolverMethod::kLevenbergMarquardt;
  return fmt::format(
      "Diverged: {} would have to change by {:.3g} {}, which no calibration error is. {}",
      p.name,
      summary.state[summary.beyond_limit],
      p.unit == Unit::kRadian ? "rad" : "m",
      noise_rule ? "The nominal robot is probably not the one that was recorded."
                 : "Either directions were followed that only the noise determines "
                   "(singular_value_tolerance: noise leaves them out), or the nominal robot is not "
                   "the one that was recorded.");
}

void DescribeSolve(const Calibration& c, const Fit& fit, FitResult* result) {
  const SolverSummary& summary = fit.summary;
  result->solver = fit.method;
  result->termination = summary.termination;
  result->message = summary.beyond_limit < 0 ? summary.message : RunawayWords(c, fit);
  result->usable = summary.IsSolutionUsable();
  result->converged = summary.Converged();
  result->seconds = summary.seconds;
  result->columns = static_cast<int>(c.parameters.size());
  result->trace = summary.trace;
  result->iterations = static_cast<int>(summary.trace.size());
  result->cost = summary.final_cost;
  if (!summary.trace.empty()) {
    result->rank = summary.trace.back().rank;
    result->kappa_norm = summary.trace.back().kappa_norm;
  }
  if (!summary.svd_of_last_step) return;
  // The paper's rule speaks of the Jacobian in metres; the rows here are whitened.
  const TruncatedSvd& svd = *summary.svd_of_last_step;
  const bool raw = c.spec.solver.rule == TruncationRule::kPaper;
  const double unit = raw ? fit.noise.sigma : 1.0;
  for (const double s : svd.s) result->singular_values.push_back(s * unit);
  result->truncation_cut = svd.cut * unit;
  result->singular_values_of = Describe(OptionsOf(c.spec.solver).truncation);
}

int NumPoses(const Calibration& c) { return static_cast<int>(c.readings.fitted.size()); }

}  // namespace

std::optional<FitAnalysis> Analyse(const Calibration& c, const Fit& fit) {
  FitAnalysis analysis;
  analysis.noise = fit.noise_seen;
  CalibrationProblem& problem = *fit.problem;
  problem.Rewhiten(analysis.noise);
  problem.set_state(fit.summary.state);
  Linearization readings, all;
  if (!Linearize(&problem, &all, &readings)) return std::nullopt;
  analysis.num_residuals = NumPoses(c) * c.measurement->kind().num_coordinates();
  analysis.cost = all.cost;
  analysis.identifiability = Identify(readings, all, problem.scales.tolerance, NumPoses(c));
  const auto by_ceres = CovarianceByCeres(analysis.identifiability.all, &problem);
  analysis.covariance_check = CompareSigmas(by_ceres, analysis.identifiability);
  if (by_ceres) analysis.identifiability.covariance = *by_ceres;
  analysis.degrees_of_freedom =
      SourceOfNoise(c).all_given()
          ? std::numeric_limits<double>::infinity()
          : std::max(1, analysis.num_residuals - analysis.identifiability.readings.rank);
  return analysis;
}

FitResult DescribeFit(const Calibration& c, const Fit& fit, const FitAnalysis* analysis) {
  FitResult result;
  DescribeSolve(c, fit, &result);
  if (analysis == nullptr) {
    // A usable solve whose solution cannot be linearised is no result.
    result.usable = false;
    return result;
  }
  const Identifiability& identifiability = analysis->identifiability;
  result.cost = analysis->cost;
  const int freedom = analysis->num_residuals - identifiability.readings.rank;
  if (SourceOfNoise(c).all_given() && freedom > 0) {
    result.chi2_reduced = 2 * analysis->cost / freedom;
    result.chi2_p = ChiSquareTail(2 * analysis->cost, freedom);
  }
  const ResidualStatistics statistics = Statistics(fit.problem->rows(), fit.summary.state);
  result.rms = statistics.rms;
  result.rms_point = statistics.rms_point;
  result.max_point = statistics.max_point;
  result.rms_rotation = statistics.rms_rotation;
  result.rank_numerical = identifiability.numerical_rank;
  result.condition_number = identifiability.condition_number;
  result.observability = identifiability.observability;
  result.null_space =
      ExplainNullSpace(identifiability.readings, c.parameters, c.spec.robot, c.measurement->kind());
  result.parameters = DescribeParameters(c, fit.summary.state, *analysis, result.null_space);
  result.covariance = identifiability.covariance;
  result.covariance_check = analysis->covariance_check.sentence;
  result.covariance_difference = analysis->covariance_check.difference;
  return result;
}

std::vector<ComparedParameter> CompareFits(const Calibration& c,
                                           const Identifiability& identifiability,
                                           const Eigen::VectorXd& gauss_newton,
                                           const Eigen::VectorXd& levenberg_marquardt) {
  const TruncatedSvd& svd = identifiability.readings;
  const Eigen::VectorXd scaled = (gauss_newton - levenberg_marquardt).cwiseQuotient(svd.scale);
  const Eigen::VectorXd hidden = svd.dropped() * (svd.dropped().transpose() * scaled);
  std::vector<ComparedParameter> compared;
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    compared.push_back({c.parameters[k].name,
                        c.parameters[k].unit,
                        gauss_newton[i],
                        levenberg_marquardt[i],
                        (scaled[i] - hidden[i]) * svd.scale[i],
                        hidden[i] * svd.scale[i]});
  }
  return compared;
}

}  // namespace dhcal
