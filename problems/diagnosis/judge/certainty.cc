#include "problems/diagnosis/judge/certainty.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <glog/logging.h>

#include "core/math/statistics.h"
#include "problems/diagnosis/refit/joint_fit.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWrongSign = 1e3, kWrongSize = 1e2;  // stands for log p of what cannot be
constexpr double kNullDirection = 1e-10;

/// v' C^-1 v over the directions that C has.
double WaldSquare(const VectorXd& v, const MatrixXd& C, int* directions) {
  const VectorXd scale = C.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale.asDiagonal() * C * scale.asDiagonal());
  const VectorXd along = eigen.eigenvectors().transpose() * scale.cwiseProduct(v);
  double square = 0;
  *directions = 0;
  for (Index k = 0; k < along.size(); ++k) {
    if (eigen.eigenvalues()[k] < kNullDirection) continue;
    square += along[k] * along[k] / eigen.eigenvalues()[k];
    ++*directions;
  }
  return square;
}

/// By a refit without the completion: along what the rows do not see a frame and the first rows
/// turn together, so far that Wald's quadratic no longer holds where the rows do see something.
double LogChanceWithout(const JointModel& model,
                        const JointRows& joint,
                        const Item& completion,
                        const EvidenceRule& rule) {
  JointState state = joint.state;
  std::vector<int> free;
  for (const int k : completion.unknowns) state.geometry[k] = 0;
  for (const int k : joint.free) {
    const auto& gone = completion.unknowns;
    if (std::find(gone.begin(), gone.end(), k) == gone.end()) free.push_back(k);
  }
  const JointRows without = FitJointly(model, state, *joint.choice, free, kFarSteps);
  const double left = SquaresLeft(model, without, joint.phi);
  const double gain = left - SquaresLeft(model, joint, joint.phi);
  return LogChanceOfGain(std::max(gain, 0.0), completion.size, left, rule);
}

/// True if every parameter that must be positive is zero or below.
bool HasImpossibleSign(const Item& item, const VectorXd& value) {
  bool signed_item = false;
  for (int k = 0; k < item.size; ++k) {
    if (!item.positive[static_cast<std::size_t>(k)]) continue;
    signed_item = true;
    if (value[k] > 0) return false;
  }
  return signed_item;
}

}  // namespace

void ShowWhatIsHeld(const MatrixXd& C, Certainty* c) {
  c->shown_value = c->value;
  c->shown_sigma = c->sigma;
  const auto surest = [&] {
    const VectorXd sigma = c->shown_sigma.cwiseMax(1e-300);
    return c->shown_value.size() == 0 ? 0.0
                                      : c->shown_value.cwiseAbs().cwiseQuotient(sigma).maxCoeff();
  };
  if (surest() >= kTuning.least_certain) return;
  const VectorXd scale = C.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale.cwiseInverse().asDiagonal() * C *
                                                      scale.cwiseInverse().asDiagonal());
  const MatrixXd& V = eigen.eigenvectors();
  const VectorXd along = V.transpose() * c->value.cwiseQuotient(scale);
  const VectorXd variance = eigen.eigenvalues().cwiseMax(kNullDirection);
  std::vector<int> order(static_cast<std::size_t>(along.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return along[a] * along[a] / variance[a] > along[b] * along[b] / variance[b];
  });
  for (; !order.empty() && surest() < kTuning.least_certain; order.pop_back()) {
    const MatrixXd kept = scale.asDiagonal() * V(Eigen::all, order);
    c->shown_value = kept * along(order);
    c->shown_sigma = (kept.array().square().matrix() * variance(order)).cwiseSqrt();
  }
}

double LogChanceOfGain(double gain, int columns, double rss, const EvidenceRule& rule) {
  const double k = columns;
  if (rule.sigma_known) {
    return LogChiSquareTail(gain / std::max(1.0, rss / rule.dof), k);
  }
  const double rest = std::max(rule.dof - k, 1.0);
  const double left = std::max(rss - gain, 1e-9 * rss);
  if (!(left > 0)) return 0;
  return LogFTail(gain / k / (left / rest), k, rest);
}

double RowVariance(const JointRows& joint, const EvidenceRule& rule) {
  const double rows = std::max(2, joint.rows->degrees_of_freedom());
  const auto unknowns =
      static_cast<double>(joint.free.size()) + static_cast<double>(joint.X.cols());
  const double dof = std::max(rows - std::min(unknowns, rows / 2), 5.0);
  const double variance = joint.y().squaredNorm() / dof;
  return rule.sigma_known ? std::max(variance, 1.0) : std::max(variance, 1e-12);
}

Certainties CertaintiesOf(const JointModel& model,
                          const JointRows& joint,
                          const std::vector<Item>& completions,
                          const EvidenceRule& rule) {
  // Where rows come several to a pose, the rule has fewer draws than there are rows.
  const double rows = std::max(2, joint.rows->degrees_of_freedom());
  const double together =
      std::max(1.0,
               (rows - std::min<double>(static_cast<double>(joint.free.size()), rows / 2)) /
                   std::max(rule.dof, 1.0));
  Certainties certainties;
  certainties.covariance = JointCovariance(model, joint);
  const MatrixXd covariance = certainties.covariance * RowVariance(joint, rule) * together;
  const auto judge = [&](const std::vector<int>& columns, const VectorXd& value) {
    Certainty c;
    c.value = value;
    const MatrixXd own = covariance(columns, columns);
    c.sigma = own.diagonal().cwiseMax(0.0).cwiseSqrt();
    int directions = 0;
    const double square = WaldSquare(value, own, &directions);
    if (directions > 0) {
      c.log_p = rule.sigma_known
                    ? LogChiSquareTail(square, directions)
                    : LogFTail(square / directions, directions, std::max(rule.dof, 1.0));
    }
    ShowWhatIsHeld(own, &c);
    return c;
  };
  const VectorXd tied = TiedValues(model, joint);
  const auto num_free = static_cast<int>(joint.free.size());
  int first = 0;
  for (const Member& member : joint.state.members) {
    std::vector<int> columns(static_cast<std::size_t>(member.item.size));
    std::iota(columns.begin(), columns.end(), num_free + first);
    certainties.members.push_back(judge(columns, tied.segment(first, member.item.size)));
    first += member.item.size;
  }
  for (const Item& item : completions) {
    std::vector<int> columns;
    for (const int unknown : item.unknowns) {
      columns.push_back(static_cast<int>(std::find(joint.free.begin(), joint.free.end(), unknown) -
                                         joint.free.begin()));
    }
    certainties.completions.push_back(judge(columns, joint.state.geometry(item.unknowns)));
    certainties.completions.back().log_p = LogChanceWithout(model, joint, item, rule);
  }
  return certainties;
}

Weakest WeakestOf(const JointModel& model,
                  const JointRows& joint,
                  const std::vector<Item>& completions,
                  const EvidenceRule& rule,
                  double false_alarm) {
  const Certainties certainties = CertaintiesOf(model, joint, completions, rule);
  Weakest weakest;
  double worst = std::log(false_alarm);
  for (std::size_t k = 0; k < certainties.members.size(); ++k) {
    const Member& member = joint.state.members[k];
    if (member.given) continue;
    double log_p = certainties.members[k].log_p +
                   std::log(static_cast<double>(rule.names) * member.item.variants);
    const VectorXd& value = certainties.members[k].value;
    const bool impossible = HasImpossibleSign(member.item, value);
    const bool oversized =
        !member.whatever_size && UsualSizes(member.item, value) > kTuning.largest_size;
    const bool by_size = oversized && !impossible && log_p <= std::log(false_alarm);
    if (impossible) log_p = kWrongSign;
    if (oversized) log_p = std::max(log_p, kWrongSize);
    VLOG(2) << fmt::format("{}: log p {:.1f}, value {} (fit {}), {:.3g} usual sizes",
                           member.item.id,
                           log_p,
                           fmt::join(value, " "),
                           fmt::join(member.value, " "),
                           UsualSizes(member.item, value));
    if (log_p <= worst) continue;
    worst = log_p;
    weakest.member = static_cast<int>(k);
    weakest.by_size = by_size;
  }
  for (std::size_t k = 0; k < completions.size(); ++k) {
    const double log_p =
        certainties.completions[k].log_p + std::log(static_cast<double>(completions.size()) + 1);
    if (log_p <= worst) continue;
    worst = log_p;
    weakest.member = -1;
    weakest.completion = static_cast<int>(k);
  }
  return weakest;
}

}  // namespace dhcal
