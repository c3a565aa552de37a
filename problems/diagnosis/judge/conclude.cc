#include "problems/diagnosis/judge/conclude.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/units.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/elsewhere.h"
#include "problems/diagnosis/judge/describe.h"
#include "problems/diagnosis/projection.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWorthReading = 3;  // standard deviations of a coordinate
constexpr double kSameThing = 1e-6;  // basis cut
constexpr double kHolds = 0.98;      // of a signature's squares

/// What tells the members of a confusability class apart (PHYSICS.md, C1 to C10).
std::string AdviceOf(const std::string& effect_class) {
  static const std::map<std::string, std::string> advice = {
      {"C1", "a second target on the base or on link 2, or a load from the side"},
      {"C2", "the full range of the joint; against gravity, the same poses with another payload"},
      {"C3", "more than 180 deg of the joint's travel, wrist flips"},
      {"C4", "approaches with another gravity load, other travel lengths, a longer dwell"},
      {"C5", "reference poses repeated through the day, a target on the base, thermometers"},
      {"C6", "measured orientations, several arm shapes before and after the step"},
      {"C7", "a second length standard"},
      {"C8", "sidebands of the line, the gear's tooth and pole counts"},
      {"column", "the same poses at other values of the column"},
      {"C9", "wrist flips and turns of joints 4 and 6 beyond 180 deg"}};
  const auto found = advice.find(effect_class);
  return found == advice.end() ? "poses over a wider range" : found->second;
}

std::set<std::string> Ids(const std::vector<Item>& set) {
  std::set<std::string> ids;
  for (const Item& item : set) ids.insert(item.id);
  return ids;
}

/// Items of the listed sets that lack all of `own`, which the model does not have.
std::vector<Item> InPlaceOf(const std::set<std::string>& own,
                            const std::set<std::string>& found,
                            const LoopOutcome& outcome) {
  std::vector<Item> others;
  std::set<std::string> known;
  for (const std::vector<Item>& set : outcome.listed) {
    const std::set<std::string> ids = Ids(set);
    const bool lacks = std::none_of(
        own.begin(), own.end(), [&](const std::string& id) { return ids.count(id) > 0; });
    if (!lacks) continue;
    for (const Item& item : set) {
      if (found.count(item.id) == 0 && known.insert(item.id).second) others.push_back(item);
    }
  }
  return others;
}

MatrixXd BasisBeside(const JointRows& fit, const MatrixXd& geometry, const Item& item) {
  if (item.kind == ItemKind::kCompletion) {
    return OrthonormalBasis(ProjectOff(geometry, fit.A(Eigen::all, item.unknowns)), kSameThing);
  }
  const MatrixXd columns = fit.rows->Columns(ColumnsOf(item, *fit.context));
  return OrthonormalBasis(ProjectOff(geometry, columns), kSameThing);
}

void AddAdvice(const Elsewhere& elsewhere,
               const LoopOutcome& outcome,
               const Member& member,
               const std::vector<Item>& others,
               Finding* finding) {
  Elsewhere::Split hardest;
  const Item* hardest_other = nullptr;
  for (const Item& other : others) {
    if (other.kind != ItemKind::kEffect) continue;
    const Elsewhere::Split split =
        elsewhere.PosesThatSplit(member.item.request, member.value, other.request);
    if (hardest_other != nullptr && split.largest >= hardest.largest) continue;
    hardest = split;
    hardest_other = &other;
  }
  const double worth = kWorthReading * outcome.noise.sigma;
  std::vector<std::string> ways;
  if (hardest.largest > worth) {
    ways.push_back(fmt::format("the poses listed, where the two differ by up to {:.2f} mm",
                               hardest.largest / kMillimetre));
    finding->separating_poses = hardest.poses;
  }
  if (hardest.with_payload > worth) {
    ways.push_back(fmt::format("the same poses with 0 and 15 kg (up to {:.2f} mm)",
                               hardest.with_payload / kMillimetre));
  }
  ways.push_back(AdviceOf(finding->effect_class));
  const std::string name = hardest_other != nullptr ? InstanceName(hardest_other->request)
                                                    : NameOf(others.front()).effect;
  finding->separating_advice =
      fmt::format("to tell it from {}: {}", name, fmt::join(ways, "; or "));
}

std::string NamesOfFindings(const DiagnosisResult& d) {
  std::vector<std::string> names;
  for (const Finding& finding : d.findings) names.push_back(InstanceName(finding.effect));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// What is added to a verdict that passes over a noise larger than stated.
std::string DoubtOf(const Judged& judged) {
  if (judged.doubted == 0) return "";
  return fmt::format(
      ", though what is left is {:.1f} times as large as the stated noise (without a pattern)",
      judged.doubted);
}

}  // namespace

void AddTwins(const PhysicsContext& context, Finding* finding) {
  const Effect& effect = *FindEffect(finding->effect.effect);
  std::vector<Confusable> twins;
  for (const EffectRequest& twin : effect.Twins(context, finding->effect)) {
    twins.push_back({twin, effect.Place(context, twin).location, 1.0});
  }
  finding->confusable_with.insert(finding->confusable_with.begin(), twins.begin(), twins.end());
}

void AddConfusables(const JointModel& model, const LoopOutcome& outcome, DiagnosisResult* d) {
  const JointRows& fit = outcome.fit;
  const std::vector<std::vector<int>> groups = FindingGroups(fit.state.members);
  std::set<std::string> found;
  for (const Member& member : fit.state.members) found.insert(member.item.id);
  for (const Item& item : outcome.completions) found.insert(item.id);
  const MatrixXd geometry = OrthonormalBasis(fit.FreeColumns());
  const auto add = [&](const std::set<std::string>& own, const MatrixXd& basis, Finding* finding) {
    std::vector<Item> others;
    for (const Item& other : InPlaceOf(own, found, outcome)) {
      Confusable confusable;
      confusable.effect = NameOf(other);
      confusable.location =
          other.kind == ItemKind::kCell
              ? other.slot
              : FindEffect(other.request.effect)->Place(*fit.context, other.request).location;
      const MatrixXd b = BasisBeside(fit, geometry, other);
      // A free function that holds the name's own shape says nothing against the name.
      const double held = (b.transpose() * basis).squaredNorm();
      if (other.kind == ItemKind::kCell && held > kHolds * static_cast<double>(basis.cols())) {
        continue;
      }
      others.push_back(other);
      const auto smaller = std::min(basis.cols(), b.cols());
      confusable.overlap =
          smaller > 0 ? (basis.transpose() * b).norm() / std::sqrt(static_cast<double>(smaller))
                      : 0.0;
      finding->confusable_with.push_back(confusable);
    }
    std::sort(finding->confusable_with.begin(),
              finding->confusable_with.end(),
              [](const Confusable& a, const Confusable& b) { return a.overlap > b.overlap; });
    return others;
  };
  // Completions come first among the findings.
  std::size_t at = d->findings.size() - groups.size() - outcome.completions.size();
  for (const Item& item : outcome.completions) {
    add({item.id}, BasisBeside(fit, geometry, item), &d->findings[at++]);
  }
  std::unique_ptr<const Elsewhere> elsewhere;  // only where there is advice to give
  for (const std::vector<int>& group : groups) {
    std::set<std::string> own;
    for (const int m : group) own.insert(fit.state.members[static_cast<std::size_t>(m)].item.id);
    const Member& first = fit.state.members[static_cast<std::size_t>(group.front())];
    Finding& finding = d->findings[at++];
    const std::vector<Item> others = add(own, BasisBeside(fit, geometry, first.item), &finding);
    AddTwins(*fit.context, &finding);
    if (others.empty()) continue;
    if (elsewhere == nullptr) {
      elsewhere = std::make_unique<const Elsewhere>(model.calibration(),
                                                    fit.state.geometry,
                                                    *fit.context,
                                                    *fit.rows,
                                                    model.calibration().parameters);
    }
    AddAdvice(*elsewhere, outcome, first, others, &finding);
  }
}

void GiveVerdict(const Judged& judged, DiagnosisResult* d) {
  bool physics = false, confusable = false;
  for (const Finding& finding : d->findings) {
    physics = physics || finding.effect_class != "geometry";
    confusable = confusable || !finding.confusable_with.empty();
  }
  const bool rest = judged.pattern() || judged.restless > 0;
  const std::string too_large =
      fmt::format("{:.1f} times as large as the stated noise, without a pattern", judged.restless);
  if (d->findings.empty() && !rest) {
    d->verdict = DiagnosisVerdict::kConsistent;
    d->summary = judged.doubted == 0
                     ? "the rigid model meets the noise; no missing effect was detected"
                     : "no missing effect was detected" + DoubtOf(judged);
  } else if (!physics && rest) {
    d->verdict = DiagnosisVerdict::kUnexplained;
    d->summary = judged.pattern()
                     ? "something is left out that no effect of the library describes"
                     : "the residuals are " + too_large +
                           ": the readings are noisier than stated, or something is left out that "
                           "no effect of the library describes";
    if (!d->findings.empty()) d->summary += ", beside " + NamesOfFindings(*d);
  } else if (confusable && !judged.cells) {
    d->verdict = DiagnosisVerdict::kAmbiguous;
    d->summary = "more than one effect explains the misfit at these poses; the likeliest: " +
                 NamesOfFindings(*d);
    if (rest) {
      d->summary += judged.pattern() ? "; what they leave exceeds the noise"
                                     : "; what they leave is " + too_large;
    }
  } else if (rest) {
    d->verdict = DiagnosisVerdict::kPartlyExplained;
    d->summary = "explained in part by " + NamesOfFindings(*d) + "; the rest " +
                 (judged.pattern() ? "exceeds the noise" : "is " + too_large);
  } else {
    d->verdict = DiagnosisVerdict::kExplained;
    d->summary = (physics ? "explained by "
                          : "the rigid model meets the noise once its geometry is complete: ") +
                 NamesOfFindings(*d) + DoubtOf(judged);
  }
}

}  // namespace dhcal
