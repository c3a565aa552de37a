#include "problems/assembly.h"

#include <map>
#include <utility>

#include <ceres/loss_function.h>
#include <glog/logging.h>

#include "problems/parameter_set.h"
#include "residuals/adjacent_position.h"
#include "residuals/distance.h"
#include "residuals/pose.h"
#include "residuals/pose_cache.h"
#include "residuals/position.h"
#include "residuals/prior.h"

namespace dhcal {
namespace {

/// Rows that the fitted readings need, in recording order, and the scopes they belong to.
struct CachePlan {
  std::vector<Scope> scopes;
  std::vector<CacheRow> rows;
  std::vector<int> recording_row;  // of each cache row
  std::map<int, int> cache_row;    // recording row -> cache row
};

/// What the effects in a scope add to a row.
std::vector<EffectTerm> EffectTerms(const Calibration& c, const Scope& scope, int row_idx) {
  std::vector<EffectTerm> terms;
  for (std::size_t k = 0; k < scope.parameters.size(); ++k) {
    const int column = c.parameters[static_cast<std::size_t>(scope.parameters[k])].effect_column;
    if (column < 0) continue;
    for (const SlotWeights& weights : c.effect_columns[static_cast<std::size_t>(column)].slots) {
      const double weight = weights.weight[row_idx];
      if (weight != 0) terms.push_back({static_cast<int>(k), weights.slot, weight});
    }
  }
  return terms;
}

std::vector<HeldTerm> HeldTerms(const Calibration& c, int row_idx) {
  std::vector<HeldTerm> terms;
  for (const SlotWeights& amount : c.held) terms.push_back({amount.slot, amount.weight[row_idx]});
  return terms;
}

CachePlan PlanCache(const Calibration& c) {
  CachePlan plan;
  for (const Reading& reading : c.readings.fitted) {
    plan.cache_row[reading.row_idx] = -1;
    if (reading.previous_idx >= 0) plan.cache_row[reading.previous_idx] = -1;
  }
  std::map<std::pair<int, int>, int> scope_of;
  for (auto& [row_idx, cache_idx] : plan.cache_row) {
    const int run = c.recording.run(row_idx), target = c.Target(row_idx);
    const auto [entry, is_new] =
        scope_of.try_emplace({run, target}, static_cast<int>(plan.scopes.size()));
    if (is_new) {
      Scope scope;
      scope.ends = c.frames.ends(run, target);
      for (std::size_t k = 0; k < c.parameters.size(); ++k) {
        if (!InScope(c.parameters[k], run, target)) continue;
        scope.parameters.push_back(static_cast<int>(k));
        scope.slots.push_back(c.parameters[k].slot);
      }
      plan.scopes.push_back(scope);
    }
    cache_idx = static_cast<int>(plan.rows.size());
    plan.rows.push_back(
        {c.recording.q.row(row_idx),
         entry->second,
         EffectTerms(c, plan.scopes[static_cast<std::size_t>(entry->second)], row_idx),
         HeldTerms(c, row_idx)});
    plan.recording_row.push_back(row_idx);
  }
  return plan;
}

/// With shared_pose noise: series of cache rows, their sigmas and the measured contrasts.
struct SharedSeries {
  RunningMeans means;
  Eigen::Matrix3Xd contrast;  // measured position minus the mean of its predecessors [m]
};

SharedSeries PlanSeries(const Calibration& c, const Noise& noise, const CachePlan& plan) {
  const auto num_rows = static_cast<Eigen::Index>(plan.rows.size());
  std::vector<int> previous(plan.rows.size(), -1);
  Eigen::VectorXd sigma(num_rows);
  Eigen::Matrix3Xd y = Eigen::Matrix3Xd::Zero(3, num_rows);  // up to one offset per series
  for (Eigen::Index k = 0; k < num_rows; ++k) {
    sigma[k] = c.RowSigma(plan.recording_row[static_cast<std::size_t>(k)], noise);
  }
  for (const Reading& reading : c.readings.fitted) {
    const int row = plan.cache_row.at(reading.row_idx);
    const int before = plan.cache_row.at(reading.previous_idx);
    previous[static_cast<std::size_t>(row)] = before;
    y.col(row) = y.col(before) + MeasuredDisplacement(c.recording, reading);
  }
  SharedSeries series;
  series.means = RunningMeans(std::move(previous), std::move(sigma));
  series.contrast = y - series.means.Means(y, 1);
  return series;
}

std::unique_ptr<ceres::LossFunction> MakeLoss(const SolverSpec& solver) {
  switch (solver.loss) {
    case LossKind::kNone:
      return nullptr;
    case LossKind::kHuber:
      return std::make_unique<ceres::HuberLoss>(solver.loss_scale);
    case LossKind::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(solver.loss_scale);
    case LossKind::kTukey:
      return std::make_unique<ceres::TukeyLoss>(solver.loss_scale);
  }
  return nullptr;
}

/// Makes the residual block of one reading.
class BlockMaker {
 public:
  BlockMaker(const Calibration& c,
             const Noise& noise,
             const CachePlan& plan,
             const PoseCache* cache)
      : c_(c), noise_(noise), plan_(plan), cache_(cache) {}

  void UseSharedSeries(Eigen::Matrix3Xd contrast) { contrast_ = std::move(contrast); }

  ceres::CostFunction* Make(const Reading& reading) const {
    const Recording& rec = c_.recording;
    const int row_idx = reading.row_idx;
    const int cached = plan_.cache_row.at(row_idx);
    const double sigma = c_.RowSigma(row_idx, noise_);
    switch (c_.spec.measurement.kind) {
      case MeasurementKind::kPosition:
        return new PositionResidual(cache_, cached, rec.p_WQ.row(row_idx), sigma);
      case MeasurementKind::kPose:
        return new PoseResidual(
            cache_, cached, c_.MeasuredPose(row_idx), sigma, noise_.sigma_rotation);
      case MeasurementKind::kDistance:
        return new DistanceResidual(
            cache_, cached, c_.Anchor(row_idx), rec.distance[row_idx], sigma);
      case MeasurementKind::kAdjacentPosition:
        break;
    }
    if (contrast_.cols() > 0) {
      return new SharedAdjacentPositionResidual(cache_, cached, contrast_.col(cached));
    }
    return new AdjacentPositionResidual(cache_,
                                        plan_.cache_row.at(reading.previous_idx),
                                        cached,
                                        MeasuredDisplacement(rec, reading),
                                        sigma);
  }

 private:
  const Calibration& c_;
  const Noise& noise_;
  const CachePlan& plan_;
  const PoseCache* cache_;
  Eigen::Matrix3Xd contrast_;
};

void AddBlocks(const Calibration& c,
               const BlockMaker& maker,
               const CachePlan& plan,
               EstimationProblem* problem) {
  const std::vector<double*> blocks = problem->blocks();
  for (double* const block : blocks) problem->problem->AddParameterBlock(block, 1);
  for (const Reading& reading : c.readings.fitted) {
    const auto cached = static_cast<std::size_t>(plan.cache_row.at(reading.row_idx));
    const Scope& scope = plan.scopes[static_cast<std::size_t>(plan.rows[cached].scope)];
    std::vector<double*> of_row;
    for (const int k : scope.parameters) of_row.push_back(blocks[static_cast<std::size_t>(k)]);
    problem->readings.push_back(
        problem->problem->AddResidualBlock(maker.Make(reading), problem->loss.get(), of_row));
  }
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (!c.parameters[k].prior_sigma) continue;
    problem->priors.push_back(problem->problem->AddResidualBlock(
        new PriorResidual(0.0, *c.parameters[k].prior_sigma), nullptr, blocks[k]));
  }
}

}  // namespace

UnknownScales ScalesOf(const std::vector<Parameter>& parameters) {
  const auto size = static_cast<Eigen::Index>(parameters.size());
  UnknownScales scales{Eigen::VectorXd(size), Eigen::VectorXd(size)};
  for (Eigen::Index k = 0; k < size; ++k) {
    const Parameter& parameter = parameters[static_cast<std::size_t>(k)];
    scales.tolerance[k] = parameter.prior_sigma.value_or(parameter.tolerance);
    scales.limit[k] = CorrectionLimit(parameter);
  }
  return scales;
}

std::unique_ptr<EstimationProblem> BuildProblem(const Calibration& c,
                                                const Noise& noise,
                                                bool with_loss) {
  auto problem = std::make_unique<EstimationProblem>();
  problem->state.assign(c.parameters.size(), 0.0);
  problem->scales = ScalesOf(c.parameters);
  problem->kappa_unit = noise.sigma;
  if (with_loss) problem->loss = MakeLoss(c.spec.solver);

  const CachePlan plan = PlanCache(c);
  auto cache = std::make_unique<PoseCache>(&c.chain,
                                           plan.scopes,
                                           plan.rows,
                                           &problem->state,
                                           c.spec.measurement.kind == MeasurementKind::kPose);
  BlockMaker maker(c, noise, plan, cache.get());
  if (c.spec.measurement.kind == MeasurementKind::kAdjacentPosition &&
      c.spec.measurement.noise == NoiseKind::kSharedPose) {
    SharedSeries series = PlanSeries(c, noise, plan);
    cache->EnableRunningMeans(std::move(series.means));
    maker.UseSharedSeries(std::move(series.contrast));
  }

  ceres::Problem::Options options;
  options.evaluation_callback = cache.get();
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem->cache = std::move(cache);
  problem->problem = std::make_unique<ceres::Problem>(options);
  AddBlocks(c, maker, plan, problem.get());
  return problem;
}

}  // namespace dhcal
