#include "problems/diagnosis/search/gram.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>

#include "core/math/products.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kVisible = 1e-7;    // of a column's squares, or geometry can do it all
constexpr double kRidge = 1e-9;      // of a scaled Gram matrix
constexpr double kImpossible = 1e6;  // evidence of what cannot be
constexpr double kBeyondSize = 1e3;  // per decade beyond the largest size
constexpr std::size_t kBestAdditions = 12;
constexpr std::size_t kPartners = 8;  // first halves of pairs
constexpr std::size_t kBestPairs = 6;

}  // namespace

double SquaresRemoved(MatrixXd block, VectorXd b, const Eigen::Ref<const VectorXd>& norm2) {
  const Index size = b.size();
  for (Index i = 0; i < size; ++i) {
    const double scale = 1 / std::sqrt(norm2[i]);
    block.row(i) *= scale;
    block.col(i) *= scale;
    b[i] *= scale;
  }
  for (Index i = 0; i < size; ++i) {
    if (block(i, i) > kVisible) continue;
    block.row(i).setZero();
    block.col(i).setZero();
    block(i, i) = 1;
    b[i] = 0;
  }
  block.diagonal().array() += kRidge;
  if (size == 1) return b[0] * b[0] / block(0, 0);
  return std::max(0.0, b.dot(Eigen::LDLT<MatrixXd>(block).solve(b)));
}

double EvidenceRule::Loss(double rss) const {
  const double x = std::max(rss, 1e-9 * dof) / dof;
  if (!sigma_known || x > 1) return dof * std::log(x);
  return rss - dof;
}

double EvidenceRule::Price(int parameters, int variants, bool chosen_name) const {
  return parameters * std::log(poses) + 2 * std::log(static_cast<double>(variants)) +
         (chosen_name ? 2 * std::log(static_cast<double>(names)) : 0.0);
}

ItemSet With(ItemSet set, int item) {
  set.insert(std::upper_bound(set.begin(), set.end(), item), item);
  return set;
}

ItemSet Without(const ItemSet& set, const ItemSet& removed) {
  ItemSet left;
  std::set_difference(
      set.begin(), set.end(), removed.begin(), removed.end(), std::back_inserter(left));
  return left;
}

SetEvaluator::SetEvaluator(Gram gram, std::vector<GramItem> items, const EvidenceRule& rule)
    : gram_(std::move(gram)), items_(std::move(items)), rule_(rule) {
  gram_.norm2 = gram_.norm2.cwiseMax(1e-300);
  for (const GramItem& item : items_) {
    int visible = 0;
    for (int k = item.first; k < item.first + item.size; ++k) {
      if (gram_.G(k, k) > kVisible * gram_.norm2[k]) ++visible;
    }
    visible_.push_back(std::max(visible, 1));
    price_.push_back(rule_.Price(visible_.back(), item.variants, item.chosen_name) +
                     (item.unnamed ? kTuning.unnamed_charge : 0.0));
  }
}

const SetValue& SetEvaluator::Evaluate(const ItemSet& set) {
  const auto found = known_.find(set);
  if (found != known_.end()) return found->second;
  std::vector<int> columns;
  std::vector<bool> positive;
  for (const int i : set) {
    const GramItem& item = items_[static_cast<std::size_t>(i)];
    for (int k = 0; k < item.size; ++k) {
      columns.push_back(item.first + k);
      positive.push_back(item.positive[static_cast<std::size_t>(k)]);
    }
  }
  VectorXd value = VectorXd::Zero(static_cast<Index>(columns.size()));
  std::vector<int> active(columns.size());
  std::iota(active.begin(), active.end(), 0);
  // Non-negative least squares: the worst wrong sign goes first, and stays at zero.
  while (!active.empty()) {
    std::vector<int> own;
    for (const int k : active) own.push_back(columns[static_cast<std::size_t>(k)]);
    const VectorXd scale = gram_.norm2(own).cwiseSqrt().cwiseInverse();
    MatrixXd scaled = scale.asDiagonal() * gram_.G(own, own) * scale.asDiagonal();
    scaled.diagonal().array() += kRidge;
    const VectorXd right = scale.cwiseProduct(gram_.b(own));
    const VectorXd solved = scale.cwiseProduct(VectorXd(Eigen::LLT<MatrixXd>(scaled).solve(right)));
    value.setZero();
    int worst = -1;
    double worst_size = 0;
    for (std::size_t i = 0; i < active.size(); ++i) {
      const auto at = static_cast<std::size_t>(active[i]);
      const auto k = static_cast<Index>(i);
      value[active[i]] = solved[k];
      const double size = solved[k] / scale[k];
      if (!positive[at] || size >= worst_size) continue;
      worst = static_cast<int>(i);
      worst_size = size;
    }
    if (worst < 0) break;
    active.erase(active.begin() + worst);
  }
  if (active.empty()) value.setZero();
  SetValue result;
  result.rss = gram_.rss;
  if (!columns.empty()) {
    const VectorXd b = gram_.b(columns);
    const MatrixXd G = gram_.G(columns, columns);
    result.rss += value.dot(G * value) - 2 * value.dot(b);
  }
  result.evidence = rule_.Loss(result.rss);
  Index first = 0;
  for (const int i : set) {
    const GramItem& item = items_[static_cast<std::size_t>(i)];
    result.values.emplace_back(value.segment(first, item.size));
    first += item.size;
    result.evidence += price(i);
    const VectorXd& own = result.values.back();
    const bool signed_item =
        std::find(item.positive.begin(), item.positive.end(), true) != item.positive.end();
    if (signed_item && own.isZero(0)) result.evidence += kImpossible;
    if (item.typical.size() == 0) continue;
    const double sizes =
        std::sqrt(own.cwiseQuotient(item.typical).squaredNorm() / static_cast<double>(item.size));
    if (sizes > 1) {
      const double decades = std::log10(sizes) / kTuning.size_decades;
      result.evidence += decades * decades;
    }
    if (sizes > kTuning.largest_size) {
      result.evidence += kBeyondSize * std::log10(sizes / kTuning.largest_size);
    }
  }
  return known_.emplace(set, std::move(result)).first->second;
}

double SetEvaluator::FrugalEvidence(const ItemSet& set) {
  constexpr double kOfNoise = 2;
  double evidence = Evaluate(set).evidence;
  for (const int i : set) {
    evidence -= visible_[static_cast<std::size_t>(i)] * (std::log(rule_.poses) - kOfNoise);
  }
  return evidence;
}

struct SetEvaluator::Beside {
  MatrixXd H;  // G - H'H is the Gram matrix beside the base
  VectorXd b;
  double rss = 0;

  MatrixXd Block(const Gram& gram, const GramItem& one, const GramItem& other) const {
    MatrixXd block = gram.G.block(one.first, other.first, one.size, other.size);
    if (H.rows() > 0) {
      block -=
          H.middleCols(one.first, one.size).transpose() * H.middleCols(other.first, other.size);
    }
    return block;
  }
};

SetEvaluator::Beside SetEvaluator::Condition(const ItemSet& base) const {
  Beside beside;
  beside.b = gram_.b;
  beside.rss = gram_.rss;
  std::vector<int> columns;
  for (const int i : base) {
    const GramItem& item = items_[static_cast<std::size_t>(i)];
    for (int k = 0; k < item.size; ++k) columns.push_back(item.first + k);
  }
  beside.H.resize(0, gram_.G.cols());
  if (columns.empty()) return beside;
  const VectorXd scale = gram_.norm2(columns).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = scale.asDiagonal() * gram_.G(columns, columns) * scale.asDiagonal();
  scaled.diagonal().array() += kRidge;
  const Eigen::LLT<MatrixXd> factor(scaled);
  const MatrixXd rows = scale.asDiagonal() * gram_.G(columns, Eigen::all);
  beside.H = DividedByRoot(factor, rows);
  const VectorXd right = scale.cwiseProduct(gram_.b(columns));
  const VectorXd half = factor.matrixL().solve(right);
  beside.b -= beside.H.transpose() * half;
  beside.rss -= half.squaredNorm();
  return beside;
}

double SetEvaluator::Gain(const MatrixXd& block, const VectorXd& b, int item) const {
  const GramItem& own = items_[static_cast<std::size_t>(item)];
  return SquaresRemoved(block, b, gram_.norm2.segment(own.first, own.size));
}

std::vector<SetEvaluator::Promise> SetEvaluator::Larger(const ItemSet& base, bool pairs) const {
  const Beside beside = Condition(base);
  const auto count = static_cast<int>(items_.size());
  double base_price = 0;
  for (const int i : base) base_price += price(i);
  std::vector<double> gains(items_.size(), 0.0);
  std::vector<MatrixXd> blocks(items_.size());
  std::vector<std::pair<double, int>> singles;
  const auto is_base = [&](int i) { return std::binary_search(base.begin(), base.end(), i); };
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const GramItem& item = items_[at];
    blocks[at] = beside.Block(gram_, item, item);
    if (is_base(i)) continue;
    gains[at] = std::min(Gain(blocks[at], beside.b.segment(item.first, item.size), i), beside.rss);
    singles.emplace_back(rule_.Loss(beside.rss - gains[at]) + price(i) + base_price, i);
  }
  std::sort(singles.begin(), singles.end());
  std::vector<Promise> promises;
  for (std::size_t k = 0; k < singles.size() && k < kBestAdditions; ++k) {
    promises.push_back({singles[k].first, With(base, singles[k].second)});
  }
  if (!pairs) return promises;
  for (std::size_t k = 0; k < singles.size() && k < kPartners; ++k) {
    const int a = singles[k].second;
    const GramItem& first = items_[static_cast<std::size_t>(a)];
    const VectorXd b_a = beside.b.segment(first.first, first.size);
    const VectorXd scale = gram_.norm2.segment(first.first, first.size).cwiseSqrt().cwiseInverse();
    MatrixXd scaled = scale.asDiagonal() * blocks[static_cast<std::size_t>(a)] * scale.asDiagonal();
    scaled.diagonal().array() += kRidge;
    const Eigen::LDLT<MatrixXd> factor(scaled);
    const VectorXd solved_b = factor.solve(scale.cwiseProduct(b_a));
    std::vector<std::pair<double, int>> seconds;
    for (int i = 0; i < count; ++i) {
      if (i == a || is_base(i)) continue;
      const GramItem& item = items_[static_cast<std::size_t>(i)];
      const MatrixXd cross = scale.asDiagonal() * beside.Block(gram_, first, item);
      const MatrixXd block =
          blocks[static_cast<std::size_t>(i)] - cross.transpose() * factor.solve(cross);
      const VectorXd b = beside.b.segment(item.first, item.size) - cross.transpose() * solved_b;
      const double gain = std::min(Gain(block, b, i), beside.rss);
      const double left = beside.rss - gains[static_cast<std::size_t>(a)] - gain;
      seconds.emplace_back(rule_.Loss(left) + price(a) + price(i) + base_price, i);
    }
    std::sort(seconds.begin(), seconds.end());
    for (std::size_t i = 0; i < seconds.size() && i < kBestPairs; ++i) {
      promises.push_back({seconds[i].first, With(With(base, a), seconds[i].second)});
    }
  }
  return promises;
}

}  // namespace dhcal
