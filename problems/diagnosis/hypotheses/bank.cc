#include "problems/diagnosis/hypotheses/bank.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Cholesky>

#include "core/base/parallel.h"
#include "core/math/products.h"
#include "problems/diagnosis/projection.h"
#include "problems/diagnosis/refit/joint_fit.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBankRidge = 1e-9;
constexpr std::size_t kMostBesideMembers = 40;
constexpr std::size_t kMostBesideOthers = 15;
constexpr std::size_t kMostLeftOut = 8;  // members that are left out in turn

}  // namespace

Bank::Bank(const JointModel& model,
           const JointRows& joint,
           std::vector<Item> items,
           const std::vector<int>& geometry)
    : joint_(joint), items_(std::move(items)) {
  for (const Member& member : joint.state.members) {
    if (member.given) continue;
    const auto same = std::find_if(
        items_.begin(), items_.end(), [&](const Item& item) { return item.SameAs(member.item); });
    members_.push_back(static_cast<int>(same - items_.begin()));
    if (same == items_.end()) items_.push_back(member.item);
  }
  TakeOut(model, geometry);
  for (const Item& item : items_) {
    first_.push_back(num_columns_);
    num_columns_ += item.size;
  }
  const Index rows = y_.size();
  C_.resize(rows, num_columns_);
  ParallelFor(static_cast<int>(items_.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    C_.middleCols(first_[i], items_[i].size) = Columns(items_[i]);
  });
  T_ = TransposedProduct(Q_, C_);
  b_ = C_.transpose() * y_ - T_.transpose() * qy_;
  prior_.resize(num_columns_);
  for (std::size_t i = 0; i < items_.size(); ++i) {
    prior_.segment(first_[i], items_[i].size) = joint.phi * items_[i].precision.cwiseAbs2();
  }
  norm2_ = C_.colwise().squaredNorm().transpose();
  norm2_ = norm2_.cwiseMax(1e-300);
  blocks_.resize(items_.size());
  ParallelFor(static_cast<int>(items_.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    const auto own = C_.middleCols(first_[i], items_[i].size);
    const auto taken = T_.middleCols(first_[i], items_[i].size);
    blocks_[i] = own.transpose() * own - taken.transpose() * taken;
    blocks_[i].diagonal() += prior_.segment(first_[i], items_[i].size);
  });
}

void Bank::TakeOut(const JointModel& model, const std::vector<int>& geometry) {
  JointRows taken = joint_;
  taken.free = geometry;
  // Effects of the problem file itself go with the geometry.
  std::vector<int> given, own;
  VectorXd value(joint_.X.cols());
  for (std::size_t m = 0; m < joint_.state.members.size(); ++m) {
    const Member& member = joint_.state.members[m];
    const int first = joint_.FirstColumn(m);
    value.segment(first, member.item.size) = member.value;
    for (int k = 0; k < member.item.size; ++k) {
      (member.given ? given : own).push_back(first + k);
    }
  }
  const MatrixXd tied = TiedMasses(model, joint_);
  taken.X = joint_.X(Eigen::all, given);
  taken.value = joint_.value(given);
  taken.precision = joint_.precision(given);
  const Augmented augmented = AugmentedRows(model, taken, tied);
  const MatrixXd Q = ThinBasis(augmented.B);
  y_ = joint_.y();
  if (!own.empty()) y_ += joint_.X(Eigen::all, own) * VectorXd(value(own));
  const std::set<int> out(geometry.begin(), geometry.end());
  for (Index k = 0; k < joint_.state.geometry.size(); ++k) {
    if (out.count(static_cast<int>(k)) == 0) y_ += joint_.A.col(k) * joint_.state.geometry[k];
  }
  VectorXd augmented_y = augmented.y;
  augmented_y.head(y_.size()) = y_;
  qy_ = Q.transpose() * augmented_y;
  rss_ = std::max(0.0, augmented_y.squaredNorm() - qy_.squaredNorm());
  Q_ = Q.topRows(y_.size());
}

MatrixXd Bank::Columns(const Item& item) const {
  if (item.kind == ItemKind::kCompletion) return joint_.A(Eigen::all, item.unknowns);
  for (std::size_t m = 0; m < joint_.state.members.size(); ++m) {
    const Member& member = joint_.state.members[m];
    if (!member.item.SameAs(item)) continue;
    return joint_.X.middleCols(joint_.FirstColumn(m), item.size);
  }
  return joint_.rows->Columns(ColumnsOf(item, *joint_.context));
}

void Bank::Add(Item item) {
  const MatrixXd columns = Columns(item);
  const MatrixXd taken = Q_.transpose() * columns;
  C_.conservativeResize(Eigen::NoChange, num_columns_ + item.size);
  T_.conservativeResize(Eigen::NoChange, num_columns_ + item.size);
  b_.conservativeResize(num_columns_ + item.size);
  norm2_.conservativeResize(num_columns_ + item.size);
  C_.rightCols(item.size) = columns;
  T_.rightCols(item.size) = taken;
  b_.tail(item.size) = columns.transpose() * y_ - taken.transpose() * qy_;
  norm2_.tail(item.size) = columns.colwise().squaredNorm().transpose().cwiseMax(1e-300);
  prior_.conservativeResize(num_columns_ + item.size);
  prior_.tail(item.size) = joint_.phi * item.precision.cwiseAbs2();
  blocks_.emplace_back(columns.transpose() * columns - taken.transpose() * taken);
  blocks_.back().diagonal() += prior_.tail(item.size);
  first_.push_back(num_columns_);
  num_columns_ += item.size;
  items_.push_back(std::move(item));
}

std::vector<int> Bank::ColumnsOfItems(const std::vector<int>& chosen) const {
  std::vector<int> columns;
  for (const int i : chosen) {
    const auto at = static_cast<std::size_t>(i);
    for (int k = 0; k < items_[at].size; ++k) columns.push_back(first_[at] + k);
  }
  return columns;
}

MatrixXd Bank::GramRows(const std::vector<int>& chosen) const {
  const auto rows_of = [&](const std::vector<int>& columns) {
    const MatrixXd own = C_(Eigen::all, columns), taken = T_(Eigen::all, columns);
    MatrixXd G = TransposedProduct(own, C_) - TransposedProduct(taken, T_);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      G(static_cast<Index>(k), columns[k]) += prior_[columns[k]];
    }
    return G;
  };
  const bool of_members = std::all_of(chosen.begin(), chosen.end(), [&](int i) {
    return std::find(members_.begin(), members_.end(), i) != members_.end();
  });
  if (!of_members) return rows_of(ColumnsOfItems(chosen));
  // Sets of members are asked for again and again, each without another one.
  const std::vector<int> all = ColumnsOfItems(members_);
  if (member_rows_.cols() != num_columns_) member_rows_ = rows_of(all);
  std::vector<int> wanted;
  for (const int column : ColumnsOfItems(chosen)) {
    wanted.push_back(static_cast<int>(std::find(all.begin(), all.end(), column) - all.begin()));
  }
  return member_rows_(wanted, Eigen::all);
}

VectorXd Bank::Gains(const std::vector<int>& active) const {
  VectorXd b = b_;
  MatrixXd H(0, num_columns_);
  if (!active.empty()) {
    const std::vector<int> columns = ColumnsOfItems(active);
    const VectorXd scale = norm2_(columns).cwiseSqrt().cwiseInverse();
    MatrixXd G = GramRows(active);
    G = scale.asDiagonal() * G;
    MatrixXd scaled = G(Eigen::all, columns) * scale.asDiagonal();
    scaled.diagonal().array() += kBankRidge;
    const Eigen::LLT<MatrixXd> factor(scaled);
    H = DividedByRoot(factor, G);
    const VectorXd right = scale.cwiseProduct(b_(columns));
    const VectorXd half = factor.matrixL().solve(right);
    b -= H.transpose() * half;
  }
  VectorXd gains = VectorXd::Zero(static_cast<Index>(items_.size()));
  ParallelFor(static_cast<int>(items_.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    if (std::find(active.begin(), active.end(), k) != active.end()) return;
    const int size = items_[i].size;
    const auto h = H.middleCols(first_[i], size);
    gains[k] = SquaresRemoved(blocks_[i] - h.transpose() * h,
                              b.segment(first_[i], size),
                              norm2_.segment(first_[i], size));
  });
  return gains;
}

Bank::Rest Bank::RestBeside(const std::vector<int>& active) const {
  Rest rest;
  rest.basis = Q_;
  rest.y = y_ - Q_ * qy_;
  if (active.empty()) return rest;
  const MatrixXd extra = OrthonormalBasisBeside(Q_, C_(Eigen::all, ColumnsOfItems(active)));
  rest.basis.conservativeResize(Eigen::NoChange, Q_.cols() + extra.cols());
  rest.basis.rightCols(extra.cols()) = extra;
  rest.y -= extra * (extra.transpose() * rest.y);
  return rest;
}

double Bank::GainBeside(const Rest& rest, const Item& item) const {
  const MatrixXd columns = Columns(item);
  const MatrixXd beside = ProjectOff(rest.basis, columns);
  return SquaresRemoved(SquareOf(beside),
                        beside.transpose() * rest.y,
                        columns.colwise().squaredNorm().transpose().cwiseMax(1e-300));
}

Gram Bank::GramOf(const std::vector<int>& chosen) const {
  const std::vector<int> columns = ColumnsOfItems(chosen);
  const MatrixXd own = C_(Eigen::all, columns), taken = T_(Eigen::all, columns);
  Gram gram;
  gram.G = SquareOf(own) - SquareOf(taken);
  gram.G.diagonal() += prior_(columns);
  gram.b = b_(columns);
  gram.norm2 = norm2_(columns);
  gram.rss = rss_;
  return gram;
}

std::vector<int> Shortlist(const Bank& bank, const EvidenceRule& rule) {
  const std::vector<Item>& items = bank.items();
  const std::vector<int>& members = bank.members();
  std::vector<std::vector<int>> contexts = {members};
  for (std::size_t k = 0; k < members.size() && k < kMostLeftOut; ++k) {
    std::vector<int> others = members;
    others.erase(others.begin() + static_cast<long>(k));
    contexts.push_back(others);
  }
  if (members.size() > 1) contexts.emplace_back();
  std::set<int> chosen(members.begin(), members.end());
  for (std::size_t c = 0; c < contexts.size(); ++c) {
    const VectorXd gains = bank.Gains(contexts[c]);
    const double variance =
        contexts[c].empty() ? std::max(1.0, bank.rss() / std::max(rule.dof, 1.0)) : 1.0;
    std::map<std::string, std::pair<double, int>> best;  // of each id
    for (std::size_t i = 0; i < items.size(); ++i) {
      const double score = gains[static_cast<Index>(i)] -
                           variance * rule.Price(items[i].size, items[i].variants, false);
      const auto at = best.try_emplace(items[i].id, score, static_cast<int>(i)).first;
      if (score > at->second.first) at->second = {score, static_cast<int>(i)};
    }
    std::vector<std::pair<double, int>> order;
    for (const auto& [id, entry] : best) {
      order.push_back(entry);
      const Item& item = items[static_cast<std::size_t>(entry.second)];
      // Gravity's effects imitate each other: the search sees all of them.
      if (c == 0 && item.elastic) chosen.insert(entry.second);
    }
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    const std::size_t most = c == 0 ? kMostBesideMembers : kMostBesideOthers;
    for (std::size_t k = 0; k < order.size() && k < most; ++k) chosen.insert(order[k].second);
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].kind == ItemKind::kCompletion) chosen.insert(static_cast<int>(i));
  }
  return {chosen.begin(), chosen.end()};
}

}  // namespace dhcal
