#include "problems/diagnosis/verdict.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/elsewhere.h"
#include "problems/diagnosis/findings.h"
#include "problems/diagnosis/projection.h"

namespace dhcal {
namespace {

constexpr double kWorthMeasuring = 3;  // standard deviations of a coordinate

const Hypothesis& At(const HypothesisSpace& space, int idx) {
  return space.all()[static_cast<std::size_t>(idx)];
}

/// Root mean square of what a cell would explain, as read [m].
double RmsOfCell(const CompleteFit& geometry, const HypothesisSpace& space, int cell) {
  const Eigen::MatrixXd basis = space.BasisOf({cell});
  const Eigen::VectorXd explained = basis * (basis.transpose() * space.y());
  return RmsAsRead(
      geometry.calibration, geometry.fit.noise_seen, space.rows().now_row(), explained);
}

void FillMap(const CompleteFit& geometry,
             const HypothesisSpace& space,
             const SearchOutcome& out,
             DiagnosisResult* d) {
  std::vector<int> cells;
  for (std::size_t k = 0; k < out.scores.size() && k < space.all().size(); ++k) {
    const Hypothesis& h = space.all()[k];
    const BlockScore& score = out.scores[k];
    if (h.named || !h.in_maximum || score.k == 0) continue;
    MapEntry entry;
    entry.slot = h.slot;
    entry.driver = h.driver_name;
    entry.statistic = score.Q;
    entry.dof = score.k;
    entry.p_value = score.p;
    d->map.push_back(entry);
    cells.push_back(static_cast<int>(k));
  }
  ParallelFor(static_cast<int>(cells.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    d->map[at].rms = RmsOfCell(geometry, space, cells[at]);
  });
  std::sort(d->map.begin(), d->map.end(), [](const MapEntry& a, const MapEntry& b) {
    return a.p_value != b.p_value ? a.p_value < b.p_value : a.statistic > b.statistic;
  });
}

void FillHypotheses(const HypothesisSpace& space, const SearchOutcome& out, DiagnosisResult* d) {
  for (const TestedSet& set : out.tested) {
    HypothesisResult result;
    for (const int k : set.members) result.effects.push_back(At(space, k).request);
    result.p_value = set.p;
    result.kept = set.kept;
    d->hypotheses.push_back(result);
  }
  std::stable_sort(d->hypotheses.begin(), d->hypotheses.end(), [](const auto& a, const auto& b) {
    return a.kept != b.kept ? a.kept : a.p_value > b.p_value;
  });
}

/// Kept sets that have another effect in the place of `member`.
std::vector<int> Alternatives(const SearchOutcome& out, int member) {
  std::vector<int> others;
  for (const TestedSet& set : out.tested) {
    if (!set.kept || set.members.size() != out.accepted.size()) continue;
    std::vector<int> added, missing;
    for (const int k : set.members) {
      if (std::find(out.accepted.begin(), out.accepted.end(), k) == out.accepted.end()) {
        added.push_back(k);
      }
    }
    for (const int k : out.accepted) {
      if (std::find(set.members.begin(), set.members.end(), k) == set.members.end()) {
        missing.push_back(k);
      }
    }
    if (added.size() == 1 && missing.size() == 1 && missing[0] == member) {
      others.push_back(added[0]);
    }
  }
  return others;
}

Confusable ConfusableWith(const HypothesisSpace& space, int member, int other) {
  Confusable confusable;
  confusable.effect = At(space, other).request;
  confusable.location = At(space, other).place.location;
  const Eigen::MatrixXd a = space.BasisOf({member});
  const Eigen::MatrixXd b = space.BasisOf({other});
  confusable.overlap = (a.transpose() * b).norm() / std::sqrt(std::min(a.cols(), b.cols()));
  return confusable;
}

void AddAlternatives(const Elsewhere& elsewhere,
                     const HypothesisSpace& space,
                     const SearchOutcome& out,
                     DiagnosisResult* d) {
  for (Finding& finding : d->findings) {
    Elsewhere::Split hardest;
    int hardest_other = -1;
    EffectClass effect_class = EffectClass::kGeometry;
    for (const int member : out.accepted) {
      if (!OneFinding(finding.effect, At(space, member).request)) continue;
      effect_class = At(space, member).place.effect_class;
      for (const int other : Alternatives(out, member)) {
        const Hypothesis& h = At(space, other);
        if (h.family == At(space, member).family) continue;
        finding.confusable_with.push_back(ConfusableWith(space, member, other));
        const Elsewhere::Split split = elsewhere.PosesThatSplit(member, other);
        if (hardest_other < 0 || split.largest < hardest.largest) {
          hardest = split;
          hardest_other = other;
        }
      }
    }
    if (hardest_other < 0) continue;
    std::sort(finding.confusable_with.begin(),
              finding.confusable_with.end(),
              [](const Confusable& a, const Confusable& b) { return a.overlap > b.overlap; });
    const double worth = kWorthMeasuring * d->misfit.noise_sigma;
    std::vector<std::string> ways;
    if (hardest.largest > worth) {
      ways.push_back(fmt::format("the poses listed, where the two differ by up to {:.2f} mm",
                                 hardest.largest / kMillimetre));
      finding.separating_poses = hardest.poses;
    }
    if (hardest.with_payload > worth) {
      ways.push_back(fmt::format("the same poses with 0 and 15 kg (up to {:.2f} mm)",
                                 hardest.with_payload / kMillimetre));
    }
    ways.emplace_back(Advice(effect_class));
    finding.separating_advice = fmt::format("to tell it from {}: {}",
                                            InstanceName(At(space, hardest_other).request),
                                            fmt::join(ways, "; or "));
  }
}

/// Pseudo-inverse of a curve's Gram matrix beside the model. What geometry and names can do as well
/// (the hats' common part, above all) leaves next to nothing of a column of squared length
/// `length2`: the smallest curve that fits leaves it out, else it would be large and mean nothing.
Eigen::MatrixXd InverseOfWhatIsLeft(const Eigen::MatrixXd& gram, double length2) {
  constexpr double kSmallest = 1e-6;  // of the largest
  constexpr double kLeft = 1e-3;      // of a column's squares
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  const double largest = values.maxCoeff();
  const double cut = std::max(kSmallest * largest, std::min(kLeft * length2, 0.5 * largest));
  const Eigen::VectorXd inverse = (values.array() > cut).select(values.cwiseInverse(), 0.0);
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

/// Turns the abscissa of a curve over a joint from DH's sense, in which it was found, into the
/// controller's, in which the recording and the reader count.
void AsTheControllerCounts(const PhysicsContext& context, Unexplained* rest) {
  for (int joint = 0; joint < context.num_joints(); ++joint) {
    if (rest->driver != fmt::format("q{}", joint + 1) || context.sign(joint) > 0) continue;
    for (CurvePoint& point : rest->curve) point.driver_value *= context.sign(joint);
    std::reverse(rest->curve.begin(), rest->curve.end());
  }
}

/// The rest as a curve: the anonymous block's slot against its driver.
Unexplained Curve(const HypothesisSpace& space,
                  const std::vector<int>& names,
                  int block,
                  double sigma_scale) {
  constexpr int kCurveKnots = 9;
  const Hypothesis& h = At(space, block);
  Unexplained rest;
  rest.slot = h.slot;
  rest.driver = h.driver_name;
  if (h.driver_values.size() == 0 || h.knots.size() < 2) return rest;
  std::vector<double> knots;
  const auto count = std::min<std::size_t>(kCurveKnots, h.knots.size());
  for (std::size_t k = 0; k < count; ++k) {
    knots.push_back(h.knots[k * (h.knots.size() - 1) / (count - 1)]);
  }
  const SlotLayout& slots = space.context().slots();
  const Eigen::MatrixXd basis = space.BasisOf(names);
  const Eigen::VectorXd y = ProjectOff(basis, space.y());
  double best = -1;
  for (int slot = 0; slot < slots.size(); ++slot) {
    const std::string name = slots.Name(slot);
    const bool of_block =
        name == h.slot || name == h.slot + "_x" || name == h.slot + "_y" || name == h.slot + "_z";
    if (!of_block) continue;
    const Eigen::MatrixXd hats = Hats(h.driver_values, knots);
    Eigen::MatrixXd X(space.y().size(), hats.cols());
    for (Eigen::Index k = 0; k < hats.cols(); ++k) {
      X.col(k) = space.rows().Column({{slot, hats.col(k)}});
    }
    const double length2 = X.colwise().squaredNorm().maxCoeff();
    X = ProjectOff(basis, ProjectOff(space.U(), X));
    const Eigen::MatrixXd inverse = InverseOfWhatIsLeft(X.transpose() * X, length2);
    const Eigen::VectorXd amount = inverse * (X.transpose() * y);
    const double removed = (X * amount).squaredNorm();
    if (removed <= best) continue;
    best = removed;
    rest.slot = name;
    rest.unit = slots.is_angle(slot) ? "rad" : "m";
    rest.curve.clear();
    for (Eigen::Index k = 0; k < amount.size(); ++k) {
      rest.curve.push_back({knots[static_cast<std::size_t>(k)],
                            amount[k],
                            sigma_scale * std::sqrt(std::max(inverse(k, k), 0.0))});
    }
  }
  AsTheControllerCounts(space.context(), &rest);
  return rest;
}

/// The accepted names that the refit left standing.
std::vector<int> Standing(const HypothesisSpace& space,
                          const SearchOutcome& out,
                          const DiagnosisResult& d) {
  std::vector<int> standing;
  for (const int k : out.accepted) {
    const bool found = std::any_of(d.findings.begin(), d.findings.end(), [&](const Finding& f) {
      return OneFinding(f.effect, At(space, k).request);
    });
    if (found) standing.push_back(k);
  }
  return standing;
}

void AddUnexplained(const HypothesisSpace& space,
                    const SearchOutcome& out,
                    const std::vector<int>& names,
                    double sigma_scale,
                    DiagnosisResult* d) {
  int block = out.anonymous.empty() ? -1 : out.anonymous.front();
  if (block < 0) {
    for (int k = 0; k < static_cast<int>(out.scores.size()); ++k) {
      const Hypothesis& h = At(space, k);
      if (h.named || !h.in_maximum) continue;
      if (block < 0 || out.scores[static_cast<std::size_t>(k)].z >
                           out.scores[static_cast<std::size_t>(block)].z) {
        block = k;
      }
    }
  }
  if (block < 0) return;
  d->unexplained = Curve(space, names, block, sigma_scale);
  const double noise = sigma_scale * d->misfit.noise_sigma;
  const auto above_noise = [&](double rms) { return std::max(rms * rms - noise * noise, 0.0); };
  if (!std::isfinite(d->rms_train_after)) {
    const auto n = static_cast<double>(space.y().size());
    d->unexplained->fraction = 1;
    d->unexplained->rms = d->misfit.noise_sigma * std::sqrt(out.removed_by_all / n);
    return;
  }
  const double before = above_noise(d->rms_train_before), after = above_noise(d->rms_train_after);
  d->unexplained->fraction = before > 0 ? std::min(after / before, 1.0) : 1.0;
  d->unexplained->rms = std::sqrt(after);
}

void AddHidden(const Elsewhere& elsewhere,
               const HypothesisSpace& space,
               const std::vector<int>& names,
               double sigma_scale,
               DiagnosisResult* d) {
  const Eigen::MatrixXd basis = space.BasisOf(names);
  const Eigen::VectorXd y = ProjectOff(basis, space.y());
  std::vector<int> hidden;
  std::set<std::string> seen;
  for (const int k : names) seen.insert(At(space, k).family);
  for (int k = 0; k < static_cast<int>(space.all().size()); ++k) {
    const Hypothesis& h = At(space, k);
    if (h.named && seen.insert(h.family).second) hidden.push_back(k);
  }
  d->hidden.resize(hidden.size());
  ParallelFor(static_cast<int>(hidden.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    d->hidden[at] = elsewhere.Risk(hidden[at], basis, y, sigma_scale);
  });
  std::sort(d->hidden.begin(), d->hidden.end(), [](const HiddenRisk& a, const HiddenRisk& b) {
    const double one = std::isnan(a.risk) ? -1 : a.risk;
    const double other = std::isnan(b.risk) ? -1 : b.risk;
    return one > other;
  });
}

std::string Names(const DiagnosisResult& d) {
  std::vector<std::string> names;
  for (const Finding& finding : d.findings) names.push_back(InstanceName(finding.effect));
  return fmt::format("{}", fmt::join(names, ", "));
}

void Decide(const SearchOutcome& out, bool rest_left, DiagnosisResult* d) {
  std::size_t physics = 0;
  bool confusable = false;
  for (const Finding& finding : d->findings) {
    if (finding.is_geometry) continue;
    ++physics;
    confusable = confusable || !finding.confusable_with.empty();
  }
  if (out.consistent) {
    const bool geometry = !d->findings.empty();
    d->verdict = geometry ? DiagnosisVerdict::kExplained : DiagnosisVerdict::kConsistent;
    d->summary = geometry
                     ? "the rigid model meets the noise once its geometry is complete: " + Names(*d)
                     : "the rigid model meets the noise; no left-out effect is demonstrated";
  } else if (physics == 0) {
    d->verdict = DiagnosisVerdict::kUnexplained;
    d->summary = "something is left out that no effect of the library describes";
  } else if (!out.complete || rest_left) {
    d->verdict = DiagnosisVerdict::kPartlyExplained;
    d->summary = "explained in part by " + Names(*d) + "; the rest is above the noise";
  } else if (confusable) {
    d->verdict = DiagnosisVerdict::kAmbiguous;
    d->summary =
        "more than one effect explains the misfit on these poses; the likeliest: " + Names(*d);
  } else {
    d->verdict = DiagnosisVerdict::kExplained;
    d->summary = "explained by " + Names(*d);
  }
}

}  // namespace

void Conclude(const CompleteFit& geometry,
              const HypothesisSpace& space,
              const SearchOutcome& outcome,
              bool rest_left,
              DiagnosisResult* d) {
  const double sigma_scale =
      d->misfit.noise_known
          ? 1.0
          : std::sqrt((space.y().squaredNorm() - outcome.removed_by_all) / d->misfit.dof);
  FillMap(geometry, space, outcome, d);
  FillHypotheses(space, outcome, d);
  const Elsewhere elsewhere(
      geometry.calibration, geometry.state(), space, geometry.calibration.parameters);
  if (outcome.complete) AddAlternatives(elsewhere, space, outcome, d);
  Decide(outcome, rest_left, d);
  const bool rest = d->verdict == DiagnosisVerdict::kPartlyExplained ||
                    d->verdict == DiagnosisVerdict::kUnexplained;
  const std::vector<int> names = Standing(space, outcome, *d);
  if (rest) AddUnexplained(space, outcome, names, sigma_scale, d);
  AddHidden(elsewhere, space, names, sigma_scale, d);
}

}  // namespace dhcal
