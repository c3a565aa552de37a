#include "problems/assembly.h"

#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "problems/parameter_set.h"
#include "residuals/prior.h"

namespace dhcal {
namespace {

// Up to here every reading is a residual block of its own. Beyond, what Ceres does per block would
// cost more than the kinematics, and a block stands for a stretch of readings.
constexpr std::size_t kMostSingleBlocks = 2000;

Scope ScopeOf(const Calibration& c, const RowLabels& labels) {
  Scope scope;
  scope.ends = c.frames.ends(labels);
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    if (!c.parameters[k].scope.Holds(labels)) continue;
    scope.parameters.push_back(static_cast<int>(k));
    scope.slots.push_back(c.parameters[k].slot);
  }
  return scope;
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

std::vector<Prior> PriorsOf(const std::vector<Parameter>& parameters) {
  std::vector<Prior> priors;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (!parameters[k].prior_sigma) continue;
    priors.push_back({static_cast<int>(k), *parameters[k].prior_sigma});
  }
  return priors;
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

RowNoise RowNoiseOf(const Calibration& c, const Noise& noise) {
  RowNoise result;
  result.sigma.resize(c.recording.num_rows());
  for (int row = 0; row < c.recording.num_rows(); ++row) {
    result.sigma[row] = c.RowSigma(row, noise);
  }
  result.sigma_rotation = noise.sigma_rotation;
  result.shared = c.spec.measurement.noise == NoiseKind::kSharedPose;
  return result;
}

ReadingRows RowsOf(const Calibration& c, const std::vector<Reading>& readings) {
  ReadingModel model;
  model.robot = &c.spec.robot;
  model.recording = &c.recording;
  model.measurement = c.measurement.get();
  model.num_unknowns = static_cast<int>(c.parameters.size());
  model.readings = readings;
  std::map<std::tuple<int, int, int>, int> scope_of;
  for (int row = 0; row < c.recording.num_rows(); ++row) {
    const RowLabels labels = c.Labels(row);
    const auto [entry, is_new] = scope_of.try_emplace({labels.run, labels.target, labels.edge},
                                                      static_cast<int>(model.scopes.size()));
    if (is_new) model.scopes.push_back(ScopeOf(c, labels));
    model.scope_of_row.push_back(entry->second);
  }
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const int column = c.parameters[k].effect_column;
    if (column < 0) continue;
    for (const SlotWeights& weights : c.effect_columns[static_cast<std::size_t>(column)].slots) {
      model.effects.push_back({static_cast<int>(k), weights.slot, &weights.weight});
    }
  }
  for (const SlotWeights& amount : c.held) model.held.push_back({amount.slot, &amount.weight});
  return ReadingRows(std::move(model));
}

CalibrationProblem::CalibrationProblem(const Calibration& c, const Noise& noise, bool with_loss)
    : EstimationProblem(static_cast<int>(c.parameters.size()),
                        [this](const Eigen::VectorXd& x) { cache_.MoveTo(x); }),
      calibration_(c),
      rows_(RowsOf(c, c.readings.fitted)),
      row_noise_(RowNoiseOf(c, noise)),
      loss_(with_loss ? MakeLoss(c.spec.solver) : nullptr),
      cache_(&rows_,
             row_noise_,
             loss_ != nullptr || c.readings.fitted.size() <= kMostSingleBlocks
                 ? BlockSize::kReading
                 : BlockSize::kStretch) {
  scales = ScalesOf(c.parameters);
  kappa_unit = noise.sigma;
  for (int block = 0; block < cache_.num_blocks(); ++block) {
    AddReading(std::make_unique<CachedBlock>(&cache_, block), loss_.get());
  }
  std::vector<Prior> priors = PriorsOf(c.parameters);
  if (!priors.empty()) AddPrior(std::make_unique<PriorBlock>(std::move(priors), num_unknowns()));
}

void CalibrationProblem::Rewhiten(const Noise& noise) {
  row_noise_ = RowNoiseOf(calibration_, noise);
  cache_.Rewhiten(row_noise_);
  kappa_unit = noise.sigma;
}

}  // namespace dhcal
