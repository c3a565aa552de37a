#include "problems/diagnosis/complete_fit.h"

#include <algorithm>
#include <cmath>

#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/projection.h"
#include "problems/noise.h"
#include "problems/start.h"

namespace dhcal {
namespace {

ProblemSpec CompleteSpec(const ProblemSpec& user) {
  ProblemSpec spec = user;
  spec.parameters.estimate = {"complete"};
  spec.parameters.fix.clear();
  spec.parameters.prior_sigma.clear();
  spec.solver.loss = LossKind::kNone;
  spec.solver.rule = TruncationRule::kNoise;
  spec.solver.kappa = std::min(spec.solver.kappa, 1e-9);
  return spec;
}

}  // namespace

CompleteFit::CompleteFit(const ProblemSpec& user_spec, const Recording& recording)
    : spec(CompleteSpec(user_spec)), calibration(spec, recording) {}

std::unique_ptr<CompleteFit> FitComplete(const ProblemSpec& spec,
                                         const Recording& recording,
                                         const std::vector<EffectRequest>& effects,
                                         const std::vector<Reading>* readings,
                                         const Progress& progress) {
  auto result = std::make_unique<CompleteFit>(spec, recording);
  Calibration& c = result->calibration;
  if (readings != nullptr) c.readings.fitted = *readings;
  AlignStart(&c);
  FitFramesAlone(&c, progress);
  std::vector<EffectRequest> all = spec.parameters.effects;
  all.insert(all.end(), effects.begin(), effects.end());
  c.SetEffects(all);
  result->fit = RunFit(
      c, SolverMethod::kSvdGaussNewton, OptionsOf(result->spec.solver), InitialNoise(c), progress);
  return result;
}

Eigen::MatrixXd GeometryBasis(const CompleteFit& fit,
                              const std::vector<Reading>& readings,
                              double rho) {
  const Calibration& c = fit.calibration;
  std::vector<Parameter> geometry;
  Eigen::VectorXd state = fit.state();
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    if (c.parameters[k].effect_column < 0) {
      geometry.push_back(c.parameters[k]);
    } else {
      state[static_cast<Eigen::Index>(k)] = 0;
    }
  }
  DesignRows rows(c, state, fit.fit.noise_seen, readings);
  if (rho != 0) rows.WhitenSerially(rho);
  return OrthonormalBasis(rows.Geometry(geometry));
}

Eigen::MatrixXd ModelBasis(const CompleteFit& fit,
                           const std::vector<Reading>& readings,
                           double rho) {
  const Calibration& c = fit.calibration;
  Eigen::MatrixXd U = GeometryBasis(fit, readings, rho);
  if (c.effect_columns.empty()) return U;
  DesignRows rows(c, fit.state(), fit.fit.noise_seen, readings);
  if (rho != 0) rows.WhitenSerially(rho);
  Eigen::MatrixXd X(rows.num_rows(), static_cast<Eigen::Index>(c.effect_columns.size()));
  for (std::size_t k = 0; k < c.effect_columns.size(); ++k) {
    X.col(static_cast<Eigen::Index>(k)) = rows.Column(c.effect_columns[k].slots);
  }
  const Eigen::MatrixXd extra = OrthonormalBasis(ProjectOff(U, X), 1e-6);
  Eigen::MatrixXd basis(U.rows(), U.cols() + extra.cols());
  basis << U, extra;
  return basis;
}

EffectEstimates EstimateEffects(const CompleteFit& fit) {
  const Calibration& c = fit.calibration;
  EffectEstimates estimates;
  const auto num_effects = static_cast<Eigen::Index>(c.effect_columns.size());
  estimates.value.resize(num_effects);
  if (num_effects == 0) return estimates;
  const DesignRows rows(c, fit.state(), fit.fit.noise_seen, c.readings.fitted);
  const Eigen::MatrixXd U = GeometryBasis(fit, c.readings.fitted);
  const Eigen::VectorXd y = ProjectOff(U, rows.y());
  Eigen::MatrixXd X(rows.num_rows(), num_effects);
  Eigen::VectorXd typical(num_effects);
  for (Eigen::Index k = 0; k < num_effects; ++k) {
    const EffectColumn& column = c.effect_columns[static_cast<std::size_t>(k)];
    typical[k] = column.typical;
    X.col(k) = typical[k] * rows.Column(column.slots);
  }
  X = ProjectOff(U, X);
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(X.transpose() * X);
  const Eigen::VectorXd step = decomposition.solve(X.transpose() * y);
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const int column = c.parameters[k].effect_column;
    if (column >= 0) {
      estimates.value[column] =
          fit.state()[static_cast<Eigen::Index>(k)] + step[column] * typical[column];
    }
  }
  const double left = (y - X * step).squaredNorm();
  estimates.dof =
      std::max<double>(1, static_cast<double>(rows.degrees_of_freedom() - U.cols() - num_effects));
  if (!SourceOfNoise(c).all_given()) estimates.sigma_scale = std::sqrt(left / estimates.dof);
  estimates.covariance = estimates.sigma_scale * estimates.sigma_scale * typical.asDiagonal() *
                         decomposition.pseudoInverse() * typical.asDiagonal();
  return estimates;
}

}  // namespace dhcal
