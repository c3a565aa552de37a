// How many ambiguous verdicts are named after ten splitting poses (problems/guides/planning.md).
// Prints each. Recordings are made with this program's own kinematics and effects: this measures
// the choice of poses, not the physics.
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/physics/effect.h"
#include "problems/diagnosis/calibrate.h"
#include "problems/plan/split.h"
#include "problems/simulate.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

constexpr int kAmbiguousCases = 20;
constexpr int kMostDraws = 400;
constexpr double kSplitSigma = 30e-6;

std::vector<EffectRequest> SplitTruths() {
  return {Request("joint_compliance", 2, {{"compliance", 3e-6}}),
          Request("joint_compliance", 3, {{"compliance", 6e-6}}),
          Request("gear_harmonic", 1, {{"sin_1", 2e-4}}, {{"order", 1}}),
          Request("gear_harmonic", 3, {{"sin_2", 2e-4}}, {{"order", 2}}),
          Request("joint_gain", 4, {{"gain", 4e-4}}),
          Request("joint_coupling", 5, {{"coupling", 4e-4}}, {{"driver_joint", 4}}),
          Request("link_bending", 2, {{"flexibility", 2e-6}}),
          Request("base_compliance", 0, {{"compliance_x", 6e-7}, {"compliance_y", 6e-7}})};
}

/// The problem with errors of its own, and poses of a narrow range.
ProblemSpec NarrowProblem(std::uint64_t seed, Recording* rows) {
  Scenario scenario;
  scenario.narrow = true;
  scenario.poses = 40;
  scenario.sigma = kSplitSigma;
  const Draw draw = MakeDraw(scenario, seed);
  ProblemSpec spec = draw.spec;
  spec.simulate.emplace();
  Rng rng(seed);
  for (const JointNumber& number : kJointNumbers) {
    Eigen::VectorXd errors(6);
    for (double& error : errors) error = 0.5 * number.tolerance * rng.Normal();
    if (number.slot != JointSlot::kBeta) spec.simulate->row_errors(number.slot) = errors;
  }
  spec.simulate->noise = kSplitSigma;
  spec.simulate->effects = {SplitTruths()[seed % SplitTruths().size()]};
  rows->q = draw.recording.q;
  return spec;
}

std::optional<DiagnosisResult> VerdictOn(const ProblemSpec& spec, const Recording& readings) {
  ProblemSpec as_user = spec;
  as_user.diagnosis.run = DiagnosisRun::kAlways;
  return Calibrate(as_user, readings, {}).diagnosis;
}

Recording ReadWithNoise(const ProblemSpec& spec, const Recording& rows, std::uint64_t seed) {
  Rng rng(seed);
  Diagnostics diagnostics;
  return SimulateAt(spec, rows, &rng, &diagnostics).value_or(Recording());
}

bool IsNamedRightly(const DiagnosisResult& d, const EffectRequest& truth) {
  return d.verdict == DiagnosisVerdict::kExplained && d.findings.size() == 1 &&
         d.findings[0].effect.effect == truth.effect && d.findings[0].effect.joint == truth.joint;
}

/// Own rows, then the others.
Recording WithMoreRows(const Recording& own, const Recording& others) {
  Recording both;
  both.q.resize(own.q.rows() + others.q.rows(), own.q.cols());
  both.q << own.q, others.q;
  return both;
}

/// How often a truth was named after so many poses more.
struct NamedCount {
  int poses = 0;
  int after_splitting = 0, after_random = 0;
};

/// The problem's own poses and `count` more, split or random ones of the whole range.
bool NamedAfter(const ProblemSpec& spec,
                const Recording& own,
                const std::vector<Alternative>& alternatives,
                const SplitOptions& options) {
  Diagnostics diagnostics;
  const auto plan = PlanSplit(spec, own, alternatives, options, &diagnostics);
  if (!plan) return false;
  const Recording all = ReadWithNoise(spec, WithMoreRows(own, plan->rows), 1000 + options.seed);
  const auto after = VerdictOn(spec, all);
  return after && IsNamedRightly(*after, spec.simulate->effects[0]);
}

TEST(SlowSplitFigures, AmbiguousVerdictsAreNamedAfterTenPoses) {
  std::vector<NamedCount> counts = {{10}, {3}};
  int cases = 0;
  for (std::uint64_t seed = 1; seed <= kMostDraws && cases < kAmbiguousCases; ++seed) {
    Recording rows;
    const ProblemSpec spec = NarrowProblem(seed, &rows);
    const Recording own = ReadWithNoise(spec, rows, seed);
    const std::optional<DiagnosisResult> d = VerdictOn(spec, own);
    if (!d || d->verdict != DiagnosisVerdict::kAmbiguous) continue;
    ++cases;
    const std::vector<Alternative> alternatives = AlternativesOf(d->hypotheses);
    std::cout << fmt::format("seed {}: {}:", seed, InstanceName(spec.simulate->effects[0]));
    for (NamedCount& named : counts) {
      SplitOptions split, random;
      split.seed = random.seed = seed;
      split.count = random.count = random.candidates = named.poses;
      const bool by_split = NamedAfter(spec, own, alternatives, split);
      const bool by_random = NamedAfter(spec, own, alternatives, random);
      named.after_splitting += by_split ? 1 : 0;
      named.after_random += by_random ? 1 : 0;
      std::cout << fmt::format(" {} poses: {}, random {};",
                               named.poses,
                               by_split ? "named" : "not named",
                               by_random ? "named" : "not named");
    }
    std::cout << std::endl;
  }
  for (const NamedCount& named : counts) {
    std::cout << fmt::format("{:2} poses: named {} of {} after splitting ones, {} after random\n",
                             named.poses,
                             named.after_splitting,
                             cases,
                             named.after_random);
  }
  EXPECT_EQ(cases, kAmbiguousCases);
  EXPECT_GE(counts[0].after_splitting, 18);
}

}  // namespace
}  // namespace dhcal
