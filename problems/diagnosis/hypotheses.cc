#include "problems/diagnosis/hypotheses.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <glog/logging.h>

#include "core/base/parallel.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/projection.h"

namespace dhcal {
namespace {

/// Effect, joint and the settings, without the values of those that are refined.
std::string FamilyOf(const Effect& effect, const EffectRequest& request) {
  std::string family = fmt::format("{}.{}", request.effect, request.joint);
  for (const auto& [key, value] : request.settings) {
    const EffectSetting* const setting = effect.FindSetting(key);
    if (setting != nullptr && setting->is_refined()) {
      family += "." + key;
    } else {
      family += fmt::format(".{}={:g}", key, value);
    }
  }
  return family;
}

}  // namespace

HypothesisSpace::HypothesisSpace(const PhysicsContext& context,
                                 const DesignRows& rows,
                                 const Eigen::MatrixXd& U,
                                 const Eigen::VectorXd& y)
    : context_(context), rows_(rows), U_(U), y_(y), X_(y.size(), 0) {}

Eigen::MatrixXd HypothesisSpace::Raw(const std::vector<EffectColumn>& columns) const {
  Eigen::MatrixXd raw(rows_.num_rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    raw.col(static_cast<Eigen::Index>(k)) = columns[k].typical * rows_.Column(columns[k].slots);
  }
  return raw;
}

ColumnRange HypothesisSpace::AddColumns(const Eigen::MatrixXd& raw) {
  const ColumnRange range{num_columns_, static_cast<int>(raw.cols())};
  if (num_columns_ + range.size > X_.cols()) {
    X_.conservativeResize(Eigen::NoChange,
                          std::max<Eigen::Index>(X_.cols() + X_.cols() / 4, 256) + range.size);
  }
  X_.middleCols(num_columns_, range.size) = ProjectOff(U_, raw);
  for (int k = 0; k < range.size; ++k) norm2_.push_back(raw.col(k).squaredNorm());
  num_columns_ += range.size;
  return range;
}

int HypothesisSpace::AddEffect(const EffectRequest& request, bool in_maximum) {
  const Effect* const effect = FindEffect(request.effect);
  CHECK(effect != nullptr);
  Hypothesis h;
  h.named = true;
  h.effect = effect;
  h.request = request;
  h.place = effect->Place(context_, request);
  h.driver = h.place.driver;
  h.family = FamilyOf(*effect, request);
  h.in_maximum = in_maximum && effect->Describe().may_be_named;
  const std::vector<EffectColumn> columns = effect->Columns(context_, request);
  h.columns = AddColumns(Raw(columns));
  const double prior = columns.front().prior_sigma / columns.front().typical;
  if (prior > 0) h.prior_variance = prior * prior;
  all_.push_back(h);
  const auto idx = static_cast<int>(all_.size()) - 1;
  std::vector<EffectColumn> errors = effect->ShapeErrors(context_, request);
  if (!errors.empty()) {
    // In units of the first parameter's column, so that its estimate scales them.
    const double typical = effect->Columns(context_, request).front().typical;
    for (EffectColumn& error : errors) error.typical = typical;
    Hypothesis shape;
    shape.in_maximum = false;
    shape.slot = h.place.location;
    shape.driver_name = "shape of " + request.effect;
    shape.columns = AddColumns(Raw(errors));
    all_.push_back(shape);
    all_[static_cast<std::size_t>(idx)].shape_block = idx + 1;
  }
  return idx;
}

int HypothesisSpace::AddMap(const MapBlock& block) {
  Eigen::MatrixXd raw(rows_.num_rows(), static_cast<Eigen::Index>(block.columns.size()));
  for (std::size_t k = 0; k < block.columns.size(); ++k) {
    raw.col(static_cast<Eigen::Index>(k)) = rows_.Column(block.columns[k]);
  }
  Hypothesis h;
  h.slot = block.slot;
  h.slot_joint = block.slot_joint;
  h.driver_name = block.driver_name;
  h.driver = block.driver;
  h.driver_values = block.driver_values;
  h.knots = block.knots;
  h.columns = AddColumns(raw);
  all_.push_back(h);
  return static_cast<int>(all_.size()) - 1;
}

Eigen::MatrixXd HypothesisSpace::BasisOf(const std::vector<int>& blocks) const {
  Eigen::Index columns = 0;
  for (const int k : blocks) columns += Projected(k).cols();
  Eigen::MatrixXd all(y_.size(), columns);
  Eigen::Index first = 0;
  for (const int k : blocks) {
    all.middleCols(first, Projected(k).cols()) = Projected(k);
    first += Projected(k).cols();
  }
  return OrthonormalBasis(all, 1e-6);
}

void HypothesisSpace::CompleteGram() const {
  const Eigen::Index known = S_.cols(), fresh = num_columns_ - known;
  if (fresh == 0) return;
  S_.conservativeResize(num_columns_, num_columns_);
  const auto added = X_.middleCols(known, fresh);
  // In strips of old and new columns; of the new ones' own square, all up to the diagonal's strip.
  constexpr Eigen::Index kStrip = 64;
  const auto strips = static_cast<int>((num_columns_ + kStrip - 1) / kStrip);
  ParallelFor(strips, [&](int strip) {
    const Eigen::Index first = strip * kStrip;
    const Eigen::Index width = std::min<Eigen::Index>(kStrip, num_columns_ - first);
    const Eigen::Index from = std::max<Eigen::Index>(first - known, 0);  // of the new columns
    S_.block(known + from, first, fresh - from, width).noalias() =
        added.rightCols(fresh - from).transpose() * X_.middleCols(first, width);
  });
  for (Eigen::Index k = known; k < num_columns_; ++k) {
    S_.row(k).tail(num_columns_ - k) = S_.col(k).tail(num_columns_ - k).transpose();
    S_.col(k).head(known) = S_.row(k).head(known).transpose();
  }
}

BlockTests HypothesisSpace::Tests(
    double nu, bool sigma_known, int draws, std::uint64_t seed, const BlockTests* before) const {
  const auto X = X_.leftCols(num_columns_);
  BlockGram gram;
  CompleteGram();
  gram.S = S_;
  gram.z = X.transpose() * y_;
  gram.norm2 = Eigen::Map<const Eigen::VectorXd>(norm2_.data(), num_columns_);
  gram.rss = y_.squaredNorm();
  gram.nu = nu;
  gram.sigma_known = sigma_known;
  constexpr Eigen::Index kFewRows = 1500;
  if (X.rows() <= kFewRows || nu <= 1.2 * num_columns_) {
    gram.rows = X;
    gram.basis = U_;
    gram.offsets = rows_.offsets();
  }
  std::vector<ColumnRange> blocks;
  std::vector<bool> in_maximum;
  for (const Hypothesis& h : all_) {
    blocks.push_back(h.columns);
    in_maximum.push_back(h.in_maximum);
  }
  return BlockTests(std::move(gram), std::move(blocks), std::move(in_maximum), draws, seed, before);
}

double HypothesisSpace::Removes(const EffectRequest& request, const Eigen::MatrixXd& extra) const {
  Eigen::MatrixXd X = ProjectOff(U_, Raw(EffectColumns(context_, request)));
  Eigen::VectorXd y = y_;
  if (extra.cols() > 0) {
    X = ProjectOff(extra, X);
    y = ProjectOff(extra, y);
  }
  const Eigen::MatrixXd basis = OrthonormalBasis(X, 1e-3);
  return (basis.transpose() * y).squaredNorm();
}

}  // namespace dhcal
