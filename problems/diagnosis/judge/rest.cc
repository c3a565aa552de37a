#include "problems/diagnosis/judge/rest.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "core/physics/registry.h"
#include "problems/diagnosis/hypotheses/hats.h"
#include "problems/diagnosis/judge/certainty.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kMostCells = 200;
constexpr int kRestKnots = 9;
constexpr double kSmallestCurve = 1e-6;  // of the largest direction
constexpr double kLeftOfColumn = 1e-3;   // of its squares: below, geometry can do it as well

/// Pseudo-inverse of a curve's Gram matrix: the smallest curve that fits.
MatrixXd CurveInverse(const MatrixXd& gram, double length2) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(gram);
  const VectorXd& values = eigen.eigenvalues();
  const double largest = values.maxCoeff();
  const double cut =
      std::max(kSmallestCurve * largest, std::min(kLeftOfColumn * length2, 0.5 * largest));
  const VectorXd inverse = (values.array() > cut).select(values.cwiseInverse(), 0.0);
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

std::vector<double> EvenKnots(const VectorXd& values) {
  std::vector<double> knots;
  const double low = values.minCoeff(), range = values.maxCoeff() - low;
  for (int k = 0; k < kRestKnots; ++k) knots.push_back(low + range * k / (kRestKnots - 1));
  return knots;
}

/// Slots that an item moves, each once.
std::vector<int> SlotsOf(const Item& item, const PhysicsContext& context) {
  std::vector<int> slots;
  for (const auto& column : ColumnsOf(item, context)) {
    for (const SlotWeights& w : column) {
      if (std::find(slots.begin(), slots.end(), w.slot) == slots.end()) slots.push_back(w.slot);
    }
  }
  return slots;
}

/// The joint coordinate that a name is a function of, if it is of one; else empty.
VectorXd DriverOfName(const Item& item, const PhysicsContext& context, std::string* name) {
  const EffectPlace place = FindEffect(item.request.effect)->Place(context, item.request);
  *name = place.driver;
  if (place.driver != "joint angle" || item.request.joint < 1) return {};
  *name = fmt::format("q{}", item.request.joint);
  return context.q(item.request.joint - 1);
}

}  // namespace

Structure StrongestStructure(const Bank& bank, const EvidenceRule& rule, double sigma) {
  const VectorXd gains = bank.Gains(bank.members());
  Structure structure;
  structure.rest = bank.RestBeside(bank.members());
  const double rss = structure.rest.y.squaredNorm();
  const auto rows = static_cast<double>(structure.rest.y.size());
  double tests = 0;
  for (Index i = 0; i < gains.size(); ++i) {
    const Item& item = bank.items()[static_cast<std::size_t>(i)];
    if (std::find(bank.members().begin(), bank.members().end(), i) != bank.members().end()) {
      continue;
    }
    ++tests;
    const double log_p = LogChanceOfGain(gains[i], item.size, rss, rule);
    if (structure.item < 0 || log_p < structure.log_p) {
      structure.log_p = log_p;
      structure.item = static_cast<int>(i);
      structure.gain = gains[i];
    }
    if (item.kind != ItemKind::kCell) continue;
    MapEntry entry;
    entry.slot = item.slot;
    entry.driver = item.driver;
    entry.statistic = gains[i];
    entry.dof = item.size;
    entry.p_value = std::exp(log_p);
    entry.rms = sigma * std::sqrt(gains[i] / std::max(rows, 1.0));
    structure.map.push_back(entry);
  }
  structure.log_p = std::min(0.0, structure.log_p + std::log(std::max(tests, 1.0)));
  std::sort(structure.map.begin(), structure.map.end(), [](const auto& a, const auto& b) {
    return a.p_value != b.p_value ? a.p_value < b.p_value : a.statistic > b.statistic;
  });
  if (structure.map.size() > kMostCells) structure.map.resize(kMostCells);
  return structure;
}

Unexplained DescribeRest(const Item& item,
                         const JointRows& joint,
                         const Bank::Rest& rest,
                         double sigma_scale) {
  const PhysicsContext& context = *joint.context;
  const SlotLayout& layout = context.slots();
  Unexplained unexplained;
  VectorXd values = item.driver_values;
  unexplained.slot = item.slot;
  unexplained.driver = item.driver;
  const std::vector<int> slots = SlotsOf(item, context);
  if (item.kind == ItemKind::kEffect) {
    values = DriverOfName(item, context, &unexplained.driver);
    unexplained.slot = slots.size() == 1
                           ? layout.Name(slots.front())
                           : FindEffect(item.request.effect)->Place(context, item.request).location;
  }
  if (values.size() == 0 || slots.empty() || !(values.maxCoeff() > values.minCoeff())) {
    return unexplained;
  }
  const std::vector<double> knots = EvenKnots(values);
  const MatrixXd hats = Hats(values, knots);
  double best = -1;
  for (const int slot : slots) {
    MatrixXd X(rest.y.size(), hats.cols());
    for (Index k = 0; k < hats.cols(); ++k) X.col(k) = joint.rows->Column({{slot, hats.col(k)}});
    const double length2 = X.colwise().squaredNorm().maxCoeff();
    X -= rest.basis * (rest.basis.transpose() * X);
    const MatrixXd inverse = CurveInverse(X.transpose() * X, length2);
    const VectorXd amount = inverse * (X.transpose() * rest.y);
    const double removed = (X * amount).squaredNorm();
    if (removed <= best) continue;
    best = removed;
    unexplained.slot = layout.Name(slot);
    unexplained.unit = layout.is_angle(slot) ? Unit::kRadian : Unit::kMetre;
    unexplained.curve.clear();
    for (Index k = 0; k < amount.size(); ++k) {
      unexplained.curve.push_back({knots[static_cast<std::size_t>(k)],
                                   amount[k],
                                   sigma_scale * std::sqrt(std::max(inverse(k, k), 0.0))});
    }
  }
  // From DH's sense of a joint to the controller's, in which the recording and the reader count.
  for (int j = 0; j < context.num_joints(); ++j) {
    if (unexplained.driver != fmt::format("q{}", j + 1) || context.sign(j) > 0) continue;
    for (CurvePoint& point : unexplained.curve) point.driver_value *= -1;
    std::reverse(unexplained.curve.begin(), unexplained.curve.end());
  }
  return unexplained;
}

}  // namespace dhcal
