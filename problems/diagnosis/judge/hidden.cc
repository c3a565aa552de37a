#include "problems/diagnosis/judge/hidden.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/elsewhere.h"
#include "problems/diagnosis/hypotheses/library.h"
#include "problems/diagnosis/judge/certainty.h"

namespace dhcal {

void AddNotTestable(const ProblemSpec& spec, const PhysicsContext& context, DiagnosisResult* d) {
  std::set<std::pair<std::string, std::string>> reported;
  for (const Effect* const effect : AllEffects()) {
    if (effect->Describe().of_head && !context.robot().head) continue;
    const std::vector<EffectRequest> candidates = effect->Candidates(context);
    for (const EffectRequest& request : candidates) {
      const auto& active = spec.parameters.effects;
      if (std::any_of(active.begin(), active.end(), [&](const EffectRequest& e) {
            return e.SameAs(request);
          })) {
        continue;
      }
      const std::string reason = effect->NotTestable(context, request);
      if (!reason.empty() && reported.emplace(request.effect, reason).second) {
        d->not_testable.push_back({InstanceName(request), reason});
      }
    }
    if (effect->Describe().is_curve) continue;  // of joints that gear_harmonic stands for
    if (candidates.empty() && effect->Place(context, {}).effect_class != "geometry") {
      const std::string needs = effect->Describe().needs;
      d->not_testable.push_back(
          {effect->Describe().name,
           needs.empty() ? "no joint or instant here that it could be at" : "needs " + needs});
    }
  }
}

void AddHiddenRisks(const JointModel& model,
                    const JointRows& fit,
                    const EvidenceRule& rule,
                    const Bank::Rest& rest,
                    DiagnosisResult* d) {
  const Elsewhere elsewhere(model.calibration(),
                            fit.state.geometry,
                            *fit.context,
                            *fit.rows,
                            model.calibration().parameters);
  std::set<std::string> seen;
  for (const Member& member : fit.state.members) seen.insert(member.item.id);
  std::vector<EffectRequest> hidden;
  for (const Effect* const effect : AllEffects()) {
    for (const EffectRequest& request : effect->Candidates(*fit.context)) {
      if (!effect->NotTestable(*fit.context, request).empty()) continue;
      if (seen.insert(NamedItem(*fit.context, request, 1).id).second) hidden.push_back(request);
    }
  }
  const double sigma_scale = std::sqrt(RowVariance(fit, rule));
  d->hidden.resize(hidden.size());
  ParallelFor(static_cast<int>(hidden.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    d->hidden[at] = elsewhere.Risk(hidden[at], rest.basis, rest.y, sigma_scale);
  });
  std::sort(d->hidden.begin(), d->hidden.end(), [](const HiddenRisk& a, const HiddenRisk& b) {
    const double one = std::isnan(a.risk) ? -1 : a.risk;
    const double other = std::isnan(b.risk) ? -1 : b.risk;
    return one > other;
  });
}

}  // namespace dhcal
