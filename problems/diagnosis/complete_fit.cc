#include "problems/diagnosis/complete_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "core/physics/registry.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/linear_model.h"
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

/// Effects with hundreds of coefficients that have priors: the readings are linear in them, so
/// that they need no place in the fit's iterations.
std::vector<bool> AreCurves(const Calibration& c, const std::vector<EffectRequest>& effects) {
  std::vector<bool> are(effects.size(), false);
  if (effects.empty()) return are;
  const PhysicsContext context = c.Context();
  for (std::size_t k = 0; k < effects.size(); ++k) {
    if (effects[k].held) continue;
    const std::vector<EffectColumn> columns = EffectColumns(context, effects[k]);
    are[k] = !columns.empty() && columns.front().prior_sigma > 0;
  }
  return are;
}

struct EffectsToFit {
  std::vector<EffectRequest> all;
  std::vector<bool> is_curve;
};

/// Unknowns by name, of whatever effects are switched on.
std::map<std::string, double> Named(const Calibration& c, const Eigen::VectorXd& state) {
  std::map<std::string, double> named;
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    named[c.parameters[k].name] = state[static_cast<Eigen::Index>(k)];
  }
  return named;
}

Eigen::VectorXd StateOf(const Calibration& c, const std::map<std::string, double>& named) {
  Eigen::VectorXd state = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(c.parameters.size()));
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const auto value = named.find(c.parameters[k].name);
    if (value != named.end()) state[static_cast<Eigen::Index>(k)] = value->second;
  }
  return state;
}

/// All unknowns of a model from its normal equations, with the noise that this solution leaves
/// instead of the one that whitened the rows.
Eigen::VectorXd SolveAll(const LinearModel& model, bool noise_given, Noise* noise) {
  constexpr int kRounds = 3;
  std::vector<int> unknowns(static_cast<std::size_t>(model.A.cols()));
  std::iota(unknowns.begin(), unknowns.end(), 0);
  const NormalEquations normal = NormalEquationsOf(model, {});
  double variance = 1;
  Eigen::VectorXd x = Solve(normal, unknowns);
  for (int round = 0; round < kRounds && !noise_given; ++round) {
    const auto dof =
        static_cast<double>(std::max<Eigen::Index>(model.A.rows() - model.A.cols(), 1));
    variance = (model.y - model.A * x).squaredNorm() / dof;
    x = Solve(normal, unknowns, variance);
  }
  noise->sigma *= std::sqrt(variance);
  noise->sigma_rotation *= std::sqrt(variance);
  return x.head(model.tolerance.size()).cwiseProduct(model.tolerance);
}

/// The curves' coefficients beside everything else, in turn with a fit of everything else with the
/// curves held. Starts from `named` and the noise of `result`; ends with all effects as unknowns.
/// Near the solution one turn does, for what couples curves and geometry is of second order.
void FitCurves(const EffectsToFit& effects,
               std::map<std::string, double> named,
               int turns,
               const Progress& progress,
               CompleteFit* result) {
  Calibration& c = result->calibration;
  const auto& [all, is_curve] = effects;
  const bool noise_given = SourceOfNoise(c).all_given();
  std::vector<EffectRequest> held = all;
  for (int turn = 0; turn < turns && result->usable(); ++turn) {
    c.SetEffects(all);
    Noise noise = result->fit.noise_seen;
    const Eigen::VectorXd values =
        SolveAll(LinearModel(c, StateOf(c, named), noise), noise_given, &noise);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (!is_curve[k]) continue;
      held[k].held = true;
      held[k].values.clear();
      for (const EffectColumn& column : EffectColumns(c.Context(), all[k])) {
        const std::string name = ParameterName(all[k], column.parameter);
        const auto parameter = std::find_if(c.parameters.begin(),
                                            c.parameters.end(),
                                            [&](const Parameter& p) { return p.name == name; });
        named[name] = held[k].values[column.parameter] = values[parameter - c.parameters.begin()];
      }
    }
    c.SetEffects(held);
    result->fit = RunFit(c,
                         {SolverMethod::kSvdGaussNewton,
                          OptionsOf(result->spec.solver),
                          noise,
                          progress,
                          StateOf(c, named)});
    for (const auto& [name, value] : Named(c, result->state())) named[name] = value;
  }
  c.SetEffects(all);
  result->fit.summary.state = StateOf(c, named);
}

}  // namespace

CompleteFit::CompleteFit(const ProblemSpec& user_spec, const Recording& recording)
    : spec(CompleteSpec(user_spec)), calibration(spec, recording) {}

std::unique_ptr<CompleteFit> FitComplete(const ProblemSpec& spec,
                                         const Recording& recording,
                                         const std::vector<EffectRequest>& effects,
                                         const Progress& progress,
                                         const CompleteFit* near) {
  auto result = std::make_unique<CompleteFit>(spec, recording);
  Calibration& c = result->calibration;
  std::vector<EffectRequest> all = spec.parameters.effects;
  all.insert(all.end(), effects.begin(), effects.end());
  const EffectsToFit to_fit{all, AreCurves(c, all)};
  const std::vector<bool>& is_curve = to_fit.is_curve;
  const bool curves = std::find(is_curve.begin(), is_curve.end(), true) != is_curve.end();
  if (curves && near != nullptr) {
    c.frames = near->calibration.frames;
    result->fit = near->fit;
    FitCurves(to_fit, Named(near->calibration, near->state()), 1, progress, result.get());
    return result;
  }
  AlignStart(&c);
  FitFramesAlone(&c, progress);
  std::vector<EffectRequest> at_zero = all;
  for (std::size_t k = 0; k < all.size(); ++k) at_zero[k].held = all[k].held || is_curve[k];
  c.SetEffects(at_zero);
  result->fit = RunFit(c, SettingsOf(c, progress));
  if (curves) FitCurves(to_fit, Named(c, result->state()), 2, progress, result.get());
  return result;
}

}  // namespace dhcal
