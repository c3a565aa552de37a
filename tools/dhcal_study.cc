// Measures the diagnosis: false alarms, naming, intervals, over many draws with fixed seeds.
//
//   dhcal_study [group] [draws]      groups: null single several outside masses all (default all,
//   100)
//   dhcal_study --vary [draws]       what changes when each deciding number is halved or doubled
//
// Prints one line per scenario and, per group, the figures that README quotes. With the group null
// the alarm rates are at 1 % and 5 %; the others run at false_alarm = 0.05.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/diagnose.h"
#include "problems/identify.h"
#include "tools/study/scenarios.h"
#include "tools/study/vary.h"

namespace dhcal {
namespace {

/// What one draw came to.
struct Score {
  double p_geometry = 1;
  DiagnosisVerdict verdict = DiagnosisVerdict::kConsistent;
  bool detected = false;
  bool truth_kept = false;    // the true set is among those that are not told apart
  bool named = false;         // alone, or with its own class only
  bool joints_right = false;  // all true places found
  bool extra = false;         // a finding that is not there
  bool singleton = false;     // exactly one physical finding without alternatives
  bool slot_right = false;    // outside the library: the rest was put at the right slot
  int intervals = 0, covered = 0;
  double seconds = 0;
  std::string findings;
};

std::string ClassOf(const PhysicsContext& context, const EffectRequest& request) {
  return FindEffect(request.effect)->Place(context, request).effect_class;
}

/// Same effect at the same joint; instants and orders may differ a little.
bool SameEffect(const EffectRequest& a, const EffectRequest& b) {
  if (a.effect != b.effect || a.joint != b.joint) return false;
  if (a.setting("driver_joint", 0) != b.setting("driver_joint", 0)) return false;
  if (std::abs(a.setting("order", 0) - b.setting("order", 0)) > 0.3) return false;
  return a.setting("flank", 0) == b.setting("flank", 0);
}

bool Holds(const std::vector<EffectRequest>& set, const EffectRequest& request) {
  return std::any_of(
      set.begin(), set.end(), [&](const EffectRequest& e) { return SameEffect(e, request); });
}

void ScoreIntervals(const Scenario& scenario, const DiagnosisResult& d, Score* score) {
  for (const Finding& finding : d.findings) {
    for (const EffectRequest& truth : scenario.truth) {
      if (!SameEffect(truth, finding.effect)) continue;
      if (truth.setting("order", 0) > 2) continue;  // the phase turns with the order's own error
      for (const FoundParameter& p : finding.parameters) {
        const std::string name = p.name.substr(p.name.rfind('.') + 1);
        const auto value = truth.values.find(name);
        const double expected = value == truth.values.end() ? 0 : value->second;
        ++score->intervals;
        score->covered += p.ci95_low <= expected && expected <= p.ci95_high ? 1 : 0;
      }
    }
  }
}

Score Judge(const Scenario& scenario, const Draw& draw, const DiagnosisResult& d) {
  const PhysicsContext context(draw.spec.robot, draw.recording, {draw.spec.robot.X_WB});
  Score score;
  score.p_geometry = d.misfit.p_value;
  score.verdict = d.verdict;
  score.seconds = d.seconds;
  score.detected = d.misfit.p_value <= d.false_alarm;
  std::vector<const Finding*> physics;
  for (const Finding& finding : d.findings) {
    if (finding.effect_class != "geometry") physics.push_back(&finding);
    score.findings += InstanceName(finding.effect) + "; ";
  }
  for (const HypothesisResult& h : d.hypotheses) {
    if (!h.kept || h.effects.size() != scenario.truth.size()) continue;
    bool all = true;
    for (const EffectRequest& truth : scenario.truth) all = all && Holds(h.effects, truth);
    score.truth_kept = score.truth_kept || all;
  }
  std::set<std::string> places, found;
  for (const EffectRequest& truth : scenario.truth) {
    places.insert(FindEffect(truth.effect)->Place(context, truth).location);
  }
  bool names_right = !scenario.truth.empty() && physics.size() == scenario.truth.size();
  for (const Finding* const finding : physics) {
    found.insert(finding->location);
    for (const Confusable& other : finding->confusable_with) found.insert(other.location);
    bool matches = false;
    for (const EffectRequest& truth : scenario.truth) {
      const std::string own = ClassOf(context, truth);
      bool listed = SameEffect(finding->effect, truth);
      bool in_class = listed || ClassOf(context, finding->effect) == own;
      for (const Confusable& other : finding->confusable_with) {
        listed = listed || SameEffect(other.effect, truth);
        in_class =
            in_class && (SameEffect(other.effect, truth) || ClassOf(context, other.effect) == own);
      }
      matches = matches || (listed && in_class);
    }
    names_right = names_right && matches;
    score.extra = score.extra || places.count(finding->location) == 0;
  }
  score.extra = score.extra || physics.size() > scenario.truth.size();
  score.named = names_right;
  score.joints_right = std::includes(found.begin(), found.end(), places.begin(), places.end());
  score.singleton = physics.size() == 1 && physics[0]->confusable_with.empty() &&
                    d.verdict == DiagnosisVerdict::kExplained;
  score.slot_right = d.unexplained && d.unexplained->slot == scenario.outside_slot;
  ScoreIntervals(scenario, d, &score);
  return score;
}

std::vector<Score> RunScenario(const Scenario& scenario, int draws) {
  std::vector<Score> scores(static_cast<std::size_t>(draws));
  ParallelFor(draws, [&](int k) {
    Draw draw = MakeDraw(scenario, static_cast<std::uint64_t>(k) + 1);
    draw.spec.diagnosis.false_alarm = 0.05;
    const Result result = IdentifyGeometry(draw.spec, draw.recording, {});
    const DiagnosisResult d = Diagnose(draw.spec, draw.recording, result, {});
    scores[static_cast<std::size_t>(k)] = Judge(scenario, draw, d);
  });
  return scores;
}

template <typename Predicate>
double Share(const std::vector<Score>& scores, Predicate predicate) {
  const auto count = std::count_if(scores.begin(), scores.end(), predicate);
  return 100.0 * static_cast<double>(count) /
         static_cast<double>(std::max<std::size_t>(scores.size(), 1));
}

std::string Line(const Scenario& scenario, const std::vector<Score>& s) {
  double seconds = 0;
  for (const Score& score : s) seconds += score.seconds / static_cast<double>(s.size());
  if (scenario.group == "null") {
    return fmt::format("{:<62} alarm at 5 %: {:5.1f} %  at 1 %: {:5.1f} %  {:.2f} s",
                       scenario.name,
                       Share(s, [](const Score& x) { return x.p_geometry <= 0.05; }),
                       Share(s, [](const Score& x) { return x.p_geometry <= 0.01; }),
                       seconds);
  }
  if (scenario.group == "outside") {
    return fmt::format(
        "{:<62} found {:5.1f}  unexplained {:5.1f}  at its slot {:5.1f}  single wrong name {:5.1f} "
        "%  "
        "{:.2f} s",
        scenario.name,
        Share(s, [](const Score& x) { return x.detected; }),
        Share(s, [](const Score& x) { return x.verdict == DiagnosisVerdict::kUnexplained; }),
        Share(s,
              [](const Score& x) {
                return x.verdict == DiagnosisVerdict::kUnexplained && x.slot_right;
              }),
        Share(s, [](const Score& x) { return x.singleton; }),
        seconds);
  }
  int intervals = 0, covered = 0;
  for (const Score& score : s) {
    intervals += score.intervals;
    covered += score.covered;
  }
  return fmt::format(
      "{:<62} found {:5.1f}  kept {:5.1f}  named {:5.1f}  place {:5.1f}  extra {:5.1f}  covers "
      "{:5.1f} % "
      "of {}  {:.2f} s",
      scenario.name,
      Share(s, [](const Score& x) { return x.detected; }),
      Share(s, [](const Score& x) { return x.truth_kept; }),
      Share(s, [](const Score& x) { return x.named; }),
      Share(s, [](const Score& x) { return x.joints_right; }),
      Share(s, [](const Score& x) { return x.extra; }),
      100.0 * covered / std::max(intervals, 1),
      intervals,
      seconds);
}

constexpr char kUsage[] =
    "usage: dhcal_study [null|single|several|outside|masses|all|part of a scenario's name] [draws] "
    "[verbose]\n"
    "       dhcal_study --vary [draws]\n";

int Run(const std::string& group, int draws, bool verbose) {
  std::vector<Score> detectable;
  bool any = false;
  for (const Scenario& scenario : AllScenarios()) {
    const bool wanted =
        group == "all" || scenario.group == group || scenario.name.find(group) != std::string::npos;
    if (!wanted) continue;
    any = true;
    const std::vector<Score> scores = RunScenario(scenario, draws);
    std::cout << Line(scenario, scores) << std::endl;
    if (verbose) {
      for (std::size_t k = 0; k < scores.size(); ++k) {
        std::cout << fmt::format("    {:3d} {:<17} p {:.4f}{} {}\n",
                                 k + 1,
                                 ToString(scores[k].verdict),
                                 scores[k].p_geometry,
                                 scores[k].truth_kept ? " kept" : "     ",
                                 scores[k].findings);
      }
    }
    const double found = Share(scores, [](const Score& x) { return x.detected; });
    if (scenario.group == "single" && found >= 90) {
      detectable.insert(detectable.end(), scores.begin(), scores.end());
    }
  }
  if (!detectable.empty()) {
    Scenario pooled;
    pooled.name = "single effects found in 90 % of draws or more, pooled";
    pooled.group = "single";
    std::cout << Line(pooled, detectable) << std::endl;
  }
  if (!any) std::cerr << "dhcal_study: no scenario is in or called '" << group << "'\n" << kUsage;
  return any ? 0 : 2;
}

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  const std::string group = argc > 1 ? argv[1] : "all";
  if (group == "--help" || group == "-h") {
    std::cout << dhcal::kUsage;
    return 0;
  }
  const int draws = argc > 2 ? std::atoi(argv[2]) : 100;
  if (draws < 1) {
    std::cerr << "dhcal_study: the number of draws must be at least 1\n" << dhcal::kUsage;
    return 2;
  }
  if (group == "--vary") {
    dhcal::PrintVaried(argc > 2 ? draws : dhcal::kDrawsOfVary, &std::cout);
    return 0;
  }
  return dhcal::Run(group, draws, argc > 3);
}
