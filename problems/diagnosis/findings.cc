#include "problems/diagnosis/findings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "core/math/statistics.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/clean_rows.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/projection.h"
#include "problems/fit_analysis.h"
#include "problems/noise.h"

namespace dhcal {
namespace {

using Eigen::VectorXd;

constexpr std::size_t kMostMoved = 8;
constexpr double kMovedSigmas = 3;
constexpr double kReplicates = 0.01;
constexpr double kTestSigmas = 2;
constexpr int kMostRunGroups = 20;  // more runs are put together

double Rms(const CompleteFit& fit, const LeftOutRows& rows, const VectorXd& whitened) {
  return RmsAsRead(fit.calibration, fit.fit.noise_seen, rows.recording_row(), whitened);
}

/// The length beyond which a reading's residual tells nothing more: as for outliers, 4.5 standard
/// deviations of the residuals, or of the noise where they are smaller.
double BoundOf(const VectorXd& whitened) {
  constexpr double kSigmas = 4.5;
  return kSigmas * std::max(1.0, RobustScale({whitened.begin(), whitened.end()}));
}

/// Residuals with each reading's cut to a length, so that one misreading has no more say than that.
VectorXd Bounded(VectorXd residuals, int coordinates, double bound) {
  for (Eigen::Index first = 0; first < residuals.size(); first += coordinates) {
    const double length = residuals.segment(first, coordinates).norm();
    if (length > bound) residuals.segment(first, coordinates) *= bound / length;
  }
  return residuals;
}

/// The test readings without the misread ones.
std::vector<Reading> SoundTestReadings(const CompleteFit& before, const CompleteFit& after) {
  const Calibration& c = after.calibration;
  return WithoutRows(c, c.readings.test, MisreadTestRows(before, after));
}

/// Effect columns of each request, counted as in the calibration.
std::vector<std::vector<int>> ColumnsOf(const std::vector<EffectRequest>& effects,
                                        const Calibration& c) {
  std::vector<std::vector<int>> columns;
  const PhysicsContext context = c.Context();
  auto next = static_cast<int>(c.effect_columns.size());
  for (auto effect = effects.rbegin(); effect != effects.rend(); ++effect) {
    const auto count = static_cast<int>(EffectColumns(context, *effect).size());
    next -= count;
    std::vector<int> own(static_cast<std::size_t>(count));
    std::iota(own.begin(), own.end(), next);
    columns.insert(columns.begin(), own);
  }
  return columns;
}

/// Sum over readings of the gain in log likelihood per reading, and its standard error.
void LogPredictive(const VectorXd& before,
                   const VectorXd& after,
                   double sigma_scale,
                   Finding* finding) {
  const VectorXd gain =
      0.5 * (before.array().square() - after.array().square()) / (sigma_scale * sigma_scale);
  const auto n = static_cast<double>(gain.size());
  finding->delta_log_predictive = gain.sum();
  const double variance = (gain.array() - gain.mean()).square().sum() / std::max(n - 1, 1.0);
  finding->log_predictive_standard_error = std::sqrt(n * variance);
}

/// Probability that a parameter's estimates of the runs scatter as they do (Cochran 1954); NaN with
/// one run. Both fitted with the geometry free.
double Replication(const CompleteFit& fit, const EffectColumn& column) {
  const Calibration& c = fit.calibration;
  const auto num_runs = static_cast<int>(c.recording.run_names.size());
  if (num_runs < 2) return kUnknown;
  const DesignRows rows(c, fit.state(), fit.fit.noise_seen, c.readings.fitted);
  const Eigen::MatrixXd U = ModelBasis(fit, c.readings.fitted);
  const int groups = std::min(num_runs, kMostRunGroups);
  Eigen::MatrixXd split(rows.num_rows(), groups);
  for (int group = 0; group < groups; ++group) {
    std::vector<SlotWeights> own = column.slots;
    for (SlotWeights& weights : own) {
      for (int row = 0; row < c.recording.num_rows(); ++row) {
        if (c.recording.run(row) % groups != group) weights.weight[row] = 0;
      }
    }
    split.col(group) = rows.Column(own);
  }
  const VectorXd y = ProjectOff(U, rows.y());
  const Eigen::MatrixXd basis = OrthonormalBasis(ProjectOff(U, split), 1e-4);
  if (basis.cols() == 0) return kUnknown;
  const double removed = (basis.transpose() * y).squaredNorm();
  const auto nu = static_cast<double>(rows.degrees_of_freedom() - U.cols());
  const auto k = static_cast<double>(basis.cols());
  return nu - k < 1 ? kUnknown : RemovalTail(removed, k, y.squaredNorm(), nu);
}

void AddParameters(const std::vector<int>& columns,
                   const CompleteFit& fit,
                   const EffectEstimates& estimates,
                   Finding* finding,
                   std::vector<EffectValue>* values) {
  const bool known = SourceOfNoise(fit.calibration).all_given();
  const double quantile =
      StudentTwoSided(0.95, known ? std::numeric_limits<double>::infinity() : estimates.dof);
  for (const int k : columns) {
    const EffectColumn& column = fit.calibration.effect_columns[static_cast<std::size_t>(k)];
    FoundParameter parameter;
    parameter.name = ParameterName(finding->effect, column.parameter);
    parameter.value = estimates.value[k];
    parameter.sigma = std::sqrt(estimates.covariance(k, k));
    parameter.ci95_low = parameter.value - quantile * parameter.sigma;
    parameter.ci95_high = parameter.value + quantile * parameter.sigma;
    parameter.unit = column.unit;
    finding->parameters.push_back(parameter);
    values->push_back({column.parameter, column.unit, parameter.value, parameter.sigma});
    if (column.positive && parameter.ci95_high < 0) {
      finding->cautions.push_back(fmt::format(
          "{} is negative, which no such mechanism can be: check the joints' signs, gravity's "
          "direction and the masses, or a controller that already compensates",
          column.parameter));
    }
    if (std::abs(parameter.value) > 100 * column.typical) {
      finding->cautions.push_back(
          fmt::format("{} is {:.0f} times its usual size: take the name with doubt",
                      column.parameter,
                      std::abs(parameter.value) / column.typical));
    }
    // Coefficients of a curve are many, and mean little one by one.
    if (column.prior_sigma > 0) continue;
    const double replication = Replication(fit, column);
    if (replication < kReplicates) {
      finding->cautions.push_back(
          fmt::format("{} differs between the runs by more than its uncertainty (p = {:.2g})",
                      column.parameter,
                      replication));
    }
  }
}

/// Effects by finding, in the order of each one's first.
std::vector<std::vector<std::size_t>> Groups(const std::vector<EffectRequest>& effects) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      return OneFinding(effects[group.front()], effects[i]);
    });
    if (same == groups.end()) {
      groups.push_back({i});
    } else {
      same->push_back(i);
    }
  }
  return groups;
}

void JudgeOnTestRows(const CompleteFit& before, const CompleteFit& after, Totals* totals) {
  const std::vector<Reading> readings = SoundTestReadings(before, after);
  totals->validation_method = "set column";
  totals->rms_test_before = RmsOfReadings(before, readings);
  totals->rms_test_after = RmsOfReadings(after, readings);
}

/// One sigma of each unknown, SI.
VectorXd Deviations(const CompleteFit& fit) {
  const std::vector<EffectColumn>& columns = fit.calibration.effect_columns;
  const bool curves = std::any_of(
      columns.begin(), columns.end(), [](const EffectColumn& c) { return c.prior_sigma > 0; });
  if (!curves) {
    return Analyse(fit.calibration, fit.fit)
        .identifiability.covariance.diagonal()
        .cwiseMax(0.0)
        .cwiseSqrt();
  }
  // The analysis of a few hundred unknowns by SVD would take longer than the fit.
  const LinearModel model(fit.calibration, fit.state(), fit.fit.noise_seen);
  const VectorXd variance = Covariance(NormalEquationsOf(model, {}).H).diagonal();
  return model.tolerance.cwiseProduct(variance.head(model.tolerance.size()).cwiseSqrt());
}

}  // namespace

bool TestRowsSpeakAgainst(const CompleteFit& before, const CompleteFit& after) {
  const auto rows_of = [&](const CompleteFit& fit) {
    return DesignRows(
        fit.calibration, fit.state(), after.fit.noise_seen, after.calibration.readings.test);
  };
  const DesignRows rows = rows_of(after);
  const double bound = BoundOf(rows.y());
  const VectorXd old = Bounded(rows_of(before).y(), rows.coordinates(), bound);
  const VectorXd now = Bounded(rows.y(), rows.coordinates(), bound);
  const double gain = old.squaredNorm() - now.squaredNorm();
  const double moved = (old - now).squaredNorm();
  return gain < 0 && gain < moved - kTestSigmas * 2 * std::sqrt(moved);
}

bool OneFinding(const EffectRequest& a, const EffectRequest& b) {
  const bool lines = a.effect == LineEffect().name() && b.effect == a.effect && b.joint == a.joint;
  return lines || a.SameAs(b);
}

std::vector<std::size_t> Unhelpful(const std::vector<EffectRequest>& effects,
                                   const CompleteFit& after) {
  const LeftOutRows rows(after, MakeFolds(after.calibration));
  const std::vector<std::vector<int>> columns = ColumnsOf(effects, after.calibration);
  std::vector<std::vector<std::size_t>> groups = Groups(effects);
  std::vector<std::size_t> gone;
  std::vector<int> dropped;
  double squares = rows.Squares(dropped);
  while (!groups.empty()) {
    std::size_t worst = groups.size();
    std::vector<int> best;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      std::vector<int> tried = dropped;
      for (const std::size_t i : groups[g]) {
        tried.insert(tried.end(), columns[i].begin(), columns[i].end());
      }
      const double without = rows.Squares(tried);
      if (without >= squares) continue;
      squares = without;
      worst = g;
      best = tried;
    }
    if (worst == groups.size()) break;
    dropped = best;
    gone.insert(gone.end(), groups[worst].begin(), groups[worst].end());
    groups.erase(groups.begin() + static_cast<long>(worst));
  }
  return gone;
}

DescribedFindings DescribeFindings(const std::vector<EffectRequest>& effects,
                                   const CompleteFit& before,
                                   const CompleteFit& after) {
  Totals totals;
  const EffectEstimates estimates = EstimateEffects(after);
  const Folds folds = MakeFolds(after.calibration);
  const LeftOutRows rows_after(after, folds);
  const VectorXd left_out = rows_after.Residuals({});
  const VectorXd fitted = rows_after.Fitted({});
  const LeftOutRows rows_before(before, folds);
  totals.validation_method = folds.method;
  totals.rms_train_before = Rms(before, rows_before, rows_before.Fitted({}));
  totals.rms_train_after = Rms(after, rows_after, fitted);
  totals.rms_test_before = Rms(before, rows_before, rows_before.Residuals({}));
  totals.rms_test_after = Rms(after, rows_after, left_out);
  const bool has_test = !after.calibration.readings.test.empty();
  if (has_test) JudgeOnTestRows(before, after, &totals);

  const std::vector<std::vector<int>> columns = ColumnsOf(effects, after.calibration);
  const PhysicsContext context = after.calibration.Context();
  std::vector<Finding> findings;
  for (const std::vector<std::size_t>& group : Groups(effects)) {
    Finding finding;
    std::vector<int> own;
    for (const std::size_t i : group) {
      const Effect& effect = *FindEffect(effects[i].effect);
      finding.effect = effects[i];
      std::vector<EffectValue> values;
      AddParameters(columns[i], after, estimates, &finding, &values);
      if (!effect.ShapeErrors(context, effects[i]).empty()) {
        finding.cautions.push_back(
            "its size rests on the masses of the problem file and is wrong by as much as they are");
      }
      finding.sentence +=
          (finding.sentence.empty() ? "" : "; ") + effect.Sentence(effects[i], values);
      own.insert(own.end(), columns[i].begin(), columns[i].end());
    }
    finding.effect = effects[group.front()];
    const EffectPlace place = FindEffect(finding.effect.effect)->Place(context, finding.effect);
    finding.effect_class = ToString(place.effect_class);
    finding.location = place.location;
    finding.driver = DriverWords(place.driver, finding.effect.joint);
    const VectorXd fitted_without = rows_after.Fitted(own);
    const VectorXd left_out_without = rows_after.Residuals(own);
    finding.rms_train_before = Rms(after, rows_after, fitted_without);
    finding.rms_train_after = totals.rms_train_after;
    finding.rms_test_before = Rms(after, rows_after, left_out_without);
    finding.rms_test_after = Rms(after, rows_after, left_out);
    if (has_test && own.size() == after.calibration.effect_columns.size()) {
      finding.rms_test_before = totals.rms_test_before;
      finding.rms_test_after = totals.rms_test_after;
    }
    LogPredictive(left_out_without, left_out, estimates.sigma_scale, &finding);
    const auto n = static_cast<double>(fitted.size());
    const auto k = static_cast<double>(own.size());
    finding.delta_bic =
        n * std::log(fitted_without.squaredNorm() / fitted.squaredNorm()) - k * std::log(n);
    const double gain = fitted_without.squaredNorm() - fitted.squaredNorm();
    finding.p_value = FTail(gain / k / (fitted.squaredNorm() / estimates.dof), k, estimates.dof);
    findings.push_back(finding);
  }
  return {findings, totals};
}

std::vector<MovedParameter> MovedParameters(const CompleteFit& before, const CompleteFit& after) {
  const VectorXd sigma = Deviations(after);
  std::vector<MovedParameter> moved;
  for (std::size_t k = 0; k < before.calibration.parameters.size(); ++k) {
    const Parameter& p = before.calibration.parameters[k];
    if (p.group == ParameterGroup::kBase || p.effect_column >= 0) continue;
    const auto i = static_cast<Eigen::Index>(k);
    MovedParameter m;
    m.name = p.name;
    m.unit = ToString(p.unit);
    m.before = before.state()[i];
    m.after = after.state()[i];
    m.sigma = sigma[i];
    if (std::abs(m.after - m.before) > kMovedSigmas * m.sigma) moved.push_back(m);
  }
  std::sort(moved.begin(), moved.end(), [](const MovedParameter& a, const MovedParameter& b) {
    return std::abs(a.after - a.before) / a.sigma > std::abs(b.after - b.before) / b.sigma;
  });
  if (moved.size() > kMostMoved) moved.resize(kMostMoved);
  return moved;
}

}  // namespace dhcal
