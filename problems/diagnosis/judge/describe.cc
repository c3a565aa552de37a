#include "problems/diagnosis/judge/describe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/math/statistics.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/spectrum.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kKnownPart = 1.0 / 3;  // sigma of a constant worth a word, in tolerances
constexpr double kMovedBy = 3;          // its standard deviations
constexpr std::size_t kMostMovedShown = 8;

bool IsCurve(const EffectRequest& request) {
  return FindEffect(request.effect)->Describe().is_curve;
}

bool OneThing(const EffectRequest& a, const EffectRequest& b) {
  if (a.SameAs(b)) return true;
  if (a.joint != b.joint) return false;
  const auto of_angle = [](const EffectRequest& r) {
    return r.effect == kLineEffect || IsCurve(r);
  };
  return of_angle(a) && of_angle(b);
}

/// Pairs of sine and cosine among what a joint's own angle does to it, beside `group`.
int LinesBeside(const std::vector<int>& group, const std::vector<Member>& members) {
  const int joint = members[static_cast<std::size_t>(group.front())].item.request.joint;
  int lines = 0;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const Item& item = members[k].item;
    const bool own = std::find(group.begin(), group.end(), static_cast<int>(k)) != group.end();
    if (!own && item.own_angle && item.request.joint == joint) lines += item.size / 2;
  }
  return lines;
}

/// Many lines of one joint are the series of a curve, not so many mechanisms; two of them beside
/// the two of a balancer are, too.
bool IsSeries(const std::vector<int>& group, const std::vector<Member>& members) {
  constexpr std::size_t kLinesOfACurve = 3;
  constexpr int kOfABalancer = 2;
  const bool has_curve = std::any_of(group.begin(), group.end(), [&](int m) {
    return IsCurve(members[static_cast<std::size_t>(m)].item.request);
  });
  if (has_curve) return false;
  const bool one_short = group.size() + 1 == kLinesOfACurve;
  return group.size() >= kLinesOfACurve ||
         (one_short && LinesBeside(group, members) >= kOfABalancer);
}

/// A curve of a joint's angle holds whatever else the angle does to itself: a slope beside it is
/// part of the curve, since the curve has no end of its own.
void JoinCurves(const std::vector<Member>& members, std::vector<std::vector<int>>* groups) {
  const auto item = [&](int m) -> const Item& { return members[static_cast<std::size_t>(m)].item; };
  for (std::vector<int>& curve : *groups) {
    const bool has_curve =
        IsSeries(curve, members) ||
        std::any_of(curve.begin(), curve.end(), [&](int m) { return IsCurve(item(m).request); });
    if (!has_curve) continue;
    for (std::vector<int>& other : *groups) {
      if (&other == &curve || other.empty()) continue;
      const Item& first = item(other.front());
      if (!first.own_angle || first.request.joint != item(curve.front()).request.joint) continue;
      curve.insert(curve.end(), other.begin(), other.end());
      other.clear();
    }
    std::sort(curve.begin(), curve.end());
  }
  groups->erase(std::remove_if(groups->begin(),
                               groups->end(),
                               [](const std::vector<int>& group) { return group.empty(); }),
                groups->end());
}

double Quantile95(const EvidenceRule& rule) {
  return StudentTwoSided(
      0.95, rule.sigma_known ? std::numeric_limits<double>::infinity() : std::max(rule.dof, 1.0));
}

FoundParameter Found(
    const std::string& name, const std::string& unit, double value, double sigma, double quantile) {
  FoundParameter found;
  found.name = name;
  found.unit = unit;
  found.value = value;
  found.sigma = sigma;
  found.ci95_low = value - quantile * sigma;
  found.ci95_high = value + quantile * sigma;
  return found;
}

/// "joint 2 has a ..."; a further member of the same joint goes on with "it".
void AddSentence(const std::string& joint, const std::string& sentence, std::string* all) {
  if (all->empty()) {
    *all = sentence;
    return;
  }
  const bool same = StartsWith(sentence, joint + " ");
  *all += "; " + (same ? "it" + sentence.substr(joint.size()) : sentence);
}

/// True if a member's size is that of masses which nobody stated.
bool RestsOnGuess(const JointModel& model, const Item& item) {
  return !model.masses_given() && item.elastic && item.request.setting("measured_torque", 0) == 0 &&
         item.request.setting("free_masses", 0) == 0;
}

/// Chance of a log p, corrected for the choice.
double Corrected(double log_p, double choices) {
  return std::exp(std::min(0.0, std::max(-690.0, log_p + std::log(std::max(choices, 1.0)))));
}

}  // namespace

EffectRequest NameOf(const Item& item) {
  EffectRequest name = item.request;
  if (item.kind == ItemKind::kCell)
    name.effect = "something unnamed at " + item.slot + " driven by " + item.driver;
  return name;
}

std::vector<int> CellMembers(const std::vector<Member>& members) {
  std::vector<int> cells;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (members[k].item.kind == ItemKind::kCell) cells.push_back(static_cast<int>(k));
  }
  return cells;
}

std::vector<std::vector<int>> FindingGroups(const std::vector<Member>& members) {
  std::vector<std::vector<int>> groups;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (members[k].given || members[k].item.kind != ItemKind::kEffect) continue;
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      return OneThing(members[static_cast<std::size_t>(group.front())].item.request,
                      members[k].item.request);
    });
    if (same == groups.end()) {
      groups.push_back({static_cast<int>(k)});
    } else {
      same->push_back(static_cast<int>(k));
    }
  }
  JoinCurves(members, &groups);
  return groups;
}

std::vector<Finding> DescribeMembers(const JointModel& model,
                                     const LoopOutcome& outcome,
                                     const Certainties& certainties,
                                     const UnseenRows& unseen,
                                     const std::vector<std::vector<int>>& groups) {
  const JointRows& fit = outcome.fit;
  const PhysicsContext& context = *fit.context;
  const double quantile = Quantile95(outcome.rule);
  const double variance = RowVariance(fit, outcome.rule);
  const double rss = fit.y().squaredNorm() / variance;
  const std::vector<int> cells = CellMembers(fit.state.members);
  std::vector<Finding> findings;
  for (const std::vector<int>& group : groups) {
    Finding finding;
    double log_p = 0, square = 0;
    int parameters = 0;
    for (const int m : group) {
      const auto at = static_cast<std::size_t>(m);
      const Member& member = fit.state.members[at];
      const Certainty& certainty = certainties.members[at];
      const EffectRequest& request = member.item.request;
      const Effect& effect = *FindEffect(request.effect);
      // A curve speaks for the lines beside it.
      if (finding.effect.effect.empty() || effect.Describe().is_curve) finding.effect = request;
      const std::vector<EffectColumn> columns = effect.Columns(context, request);
      std::vector<EffectValue> values;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const auto i = static_cast<Index>(k);
        finding.parameters.push_back(Found(ParameterName(request, columns[k].parameter),
                                           columns[k].unit,
                                           certainty.shown_value[i],
                                           certainty.shown_sigma[i],
                                           quantile));
        values.push_back({columns[k].parameter,
                          columns[k].unit,
                          certainty.shown_value[i],
                          certainty.shown_sigma[i]});
        if (columns[k].positive && finding.parameters.back().ci95_high < 0) {
          finding.cautions.push_back(columns[k].parameter +
                                     " is negative, which no such mechanism can be");
        }
      }
      const bool guess = RestsOnGuess(model, member.item);
      if (guess) {
        finding.cautions.emplace_back(
            "the masses are not given (robot.links): usual ones were assumed, so its size is a "
            "guess");
      } else if (model.masses_given() && member.item.elastic &&
                 request.setting("measured_torque", 0) == 0) {
        finding.cautions.emplace_back(
            "its size rests on the masses of the problem file and is wrong by as much as they are");
      }
      std::string sentence = effect.Sentence(context, request, values);
      if (guess) sentence += " (of masses that were assumed)";
      AddSentence(JointWords(context.robot(), request.joint), sentence, &finding.sentence);
      log_p = std::min(log_p,
                       certainty.log_p + std::log(static_cast<double>(outcome.rule.names) *
                                                  member.item.variants));
      parameters += member.item.size;
      const VectorXd scaled = certainty.value.cwiseQuotient(certainty.sigma.cwiseMax(1e-300));
      square += scaled.squaredNorm();
    }
    if (IsSeries(group, fit.state.members)) {
      finding.effect.effect = CurveEffect().Describe().name;
      finding.effect.settings.clear();
      finding.sentence =
          fmt::format("{} has an angle-dependent transmission error, here as a sum of lines: {}",
                      JointWords(context.robot(), finding.effect.joint),
                      finding.sentence);
    }
    const EffectPlace place = FindEffect(finding.effect.effect)->Place(context, finding.effect);
    finding.effect_class = place.effect_class;
    finding.location = place.location;
    finding.driver = place.driver;
    finding.p_value = Corrected(log_p, 1);
    std::vector<int> without = cells;
    without.insert(without.end(), group.begin(), group.end());
    finding.rms_train_before = unseen.FittedRms(without);
    finding.rms_train_after = unseen.FittedRms(cells);
    finding.rms_test_before = unseen.UnseenRms(without);
    finding.rms_test_after = unseen.UnseenRms(cells);
    const UnseenRows::Gain gain = unseen.GainOf(group, 0);
    finding.delta_log_predictive = gain.sum;
    finding.log_predictive_standard_error = gain.error;
    finding.delta_bic = outcome.rule.Loss(rss + square) - outcome.rule.Loss(rss) -
                        parameters * std::log(outcome.rule.poses);
    findings.push_back(finding);
  }
  return findings;
}

std::vector<Finding> DescribeCompletions(const JointModel& model,
                                         const LoopOutcome& outcome,
                                         const Certainties& certainties) {
  const JointRows& fit = outcome.fit;
  const std::vector<Parameter>& parameters = model.calibration().parameters;
  const double quantile = Quantile95(outcome.rule);
  std::vector<Finding> findings;
  for (std::size_t k = 0; k < outcome.completions.size(); ++k) {
    const Item& item = outcome.completions[k];
    const Certainty& certainty = certainties.completions[k];
    const Effect& effect = *FindEffect(item.request.effect);
    const std::vector<EffectColumn> columns = effect.Columns(*fit.context, item.request);
    Finding finding;
    finding.effect = item.request;
    const EffectPlace place = effect.Place(*fit.context, item.request);
    finding.effect_class = place.effect_class;
    finding.location = place.location;
    finding.driver = place.driver;
    finding.p_value =
        Corrected(certainty.log_p, static_cast<double>(outcome.completions.size()) + 1);
    std::vector<EffectValue> values;
    for (std::size_t i = 0; i < item.unknowns.size(); ++i) {
      const Parameter& own = parameters[static_cast<std::size_t>(item.unknowns[i])];
      const auto column = std::find_if(columns.begin(), columns.end(), [&](const EffectColumn& e) {
        return e.slots.front().slot == own.slot;
      });
      if (column == columns.end()) continue;
      const auto at = static_cast<Index>(i);
      finding.parameters.push_back(Found(ParameterName(item.request, column->parameter),
                                         column->unit,
                                         certainty.shown_value[at],
                                         certainty.shown_sigma[at],
                                         quantile));
      // Frames may come once per run or target: the sentence speaks of the first.
      const bool first = std::none_of(values.begin(), values.end(), [&](const EffectValue& v) {
        return v.parameter == column->parameter;
      });
      if (first && certainty.shown_sigma[at] <= kKnownPart * own.tolerance) {
        values.push_back({column->parameter,
                          column->unit,
                          certainty.shown_value[at],
                          certainty.shown_sigma[at]});
      }
    }
    finding.sentence = effect.Sentence(*fit.context, item.request, values);
    findings.push_back(finding);
  }
  return findings;
}

std::vector<EffectRequest> ModelOf(const LoopOutcome& outcome, const Certainties& certainties) {
  std::vector<EffectRequest> effects;
  for (std::size_t m = 0; m < outcome.fit.state.members.size(); ++m) {
    const Member& member = outcome.fit.state.members[m];
    if (member.given || member.item.kind != ItemKind::kEffect) continue;
    effects.push_back(WithValues(member.item, *outcome.fit.context, certainties.members[m].value));
  }
  return effects;
}

std::vector<MovedParameter> MovedByPhysics(const JointModel& model,
                                           const LoopOutcome& outcome,
                                           const Certainties& certainties,
                                           const VectorXd& before) {
  const JointRows& fit = outcome.fit;
  const MatrixXd covariance = certainties.covariance * RowVariance(fit, outcome.rule);
  std::vector<MovedParameter> moved;
  for (std::size_t k = 0; k < fit.free.size(); ++k) {
    const int unknown = fit.free[k];
    const Parameter& p = model.calibration().parameters[static_cast<std::size_t>(unknown)];
    if (p.group == ParameterGroup::kBase) continue;
    MovedParameter m;
    m.name = p.name;
    m.unit = p.unit;
    m.before = before[unknown];
    m.after = fit.state.geometry[unknown];
    const auto at = static_cast<Index>(k);
    m.sigma = std::sqrt(std::max(covariance(at, at), 0.0));
    if (std::abs(m.after - m.before) > kMovedBy * m.sigma) moved.push_back(m);
  }
  std::sort(moved.begin(), moved.end(), [](const MovedParameter& a, const MovedParameter& b) {
    return std::abs(a.after - a.before) / a.sigma > std::abs(b.after - b.before) / b.sigma;
  });
  if (moved.size() > kMostMovedShown) moved.resize(kMostMovedShown);
  return moved;
}

}  // namespace dhcal
