// Splitting poses: the distance of two alternatives is what a fit of the wrong one leaves, and the
// poses chosen make it larger than others do.
#include "problems/plan/split.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "problems/identify.h"
#include "problems/simulate.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

/// A robot with masses, read to 30 um, whose second joint yields; small corrections only, so that
/// the linear model holds.
ProblemSpec Compliant() {
  ProblemSpec spec = MakeDraw(Scenario(), 1).spec;
  spec.simulate.emplace();
  spec.simulate->effects = {Request("joint_compliance", 2, {{"compliance", 3e-6}})};
  return spec;
}

/// Poses that differ by some ten degrees.
Recording NarrowRows(int count) {
  Rng rng(4);
  Recording rows;
  rows.q.resize(count, 6);
  for (double& angle : rows.q.reshaped()) angle = 0.3 + rng.Uniform(-0.2, 0.2);
  return rows;
}

Recording ReadExactly(const ProblemSpec& spec, const Recording& rows) {
  Rng rng(1);
  Diagnostics diagnostics;
  const auto read = SimulateAt(spec, rows, &rng, &diagnostics);
  EXPECT_TRUE(read.has_value()) << diagnostics.ToString();
  return read.value_or(Recording());
}

std::vector<Alternative> TwoNames() {
  return {{Request("joint_compliance", 2)}, {Request("gear_harmonic", 2, {}, {{"order", 1}})}};
}

/// What a fit with the other alternative leaves, in standard deviations: of the readings, and of
/// the rows' numbers within their tolerances (core/NOTATION.md).
double LeftByFit(ProblemSpec spec, const Recording& readings, const Alternative& other) {
  spec.parameters.effects = other;
  spec.parameters.prior_sigma = {
      {"theta", 3e-3}, {"alpha", 1e-3}, {"beta", 1e-3}, {"a", 0.5e-3}, {"d", 0.5e-3}};
  const Result result = IdentifyGeometry(spec, readings, {});
  return result.best() == nullptr ? -1 : std::sqrt(2 * result.best()->cost);
}

double DistanceIn(const SplitPlan& plan, bool after) {
  for (const SplitPair& pair : plan.pairs) {
    if (pair.truth == "joint_compliance at joint 2") return after ? pair.after : pair.before;
  }
  return -1;
}

TEST(PlanSplit, TheDistanceIsWhatAFitOfTheOtherLeaves) {
  const ProblemSpec spec = Compliant();
  const Recording own = ReadExactly(spec, NarrowRows(40));
  Diagnostics diagnostics;
  SplitOptions options;
  options.candidates = 60;
  const auto plan = PlanSplit(spec, own, TwoNames(), options, &diagnostics);
  ASSERT_TRUE(plan.has_value()) << diagnostics.ToString();
  ASSERT_EQ(plan->rows.num_rows(), 10);
  Recording both;
  both.q.resize(50, 6);
  both.q << own.q, plan->rows.q;
  const double before = LeftByFit(spec, own, TwoNames()[1]);
  const double after = LeftByFit(spec, ReadExactly(spec, both), TwoNames()[1]);
  EXPECT_NEAR(DistanceIn(*plan, /*after=*/false), before, 0.1 * before);
  EXPECT_NEAR(DistanceIn(*plan, /*after=*/true), after, 0.1 * after);
  EXPECT_GT(after, 4 * before);
}

TEST(PlanSplit, ChoosesPosesThatSplitBetterThanOthers) {
  const ProblemSpec spec = Compliant();
  const Recording own = ReadExactly(spec, NarrowRows(40));
  Diagnostics diagnostics;
  SplitOptions chosen, all;
  chosen.candidates = 60;
  all.candidates = all.count = 10;  // all ten that there are: random ones
  const auto good = PlanSplit(spec, own, TwoNames(), chosen, &diagnostics);
  const auto random = PlanSplit(spec, own, TwoNames(), all, &diagnostics);
  ASSERT_TRUE(good && random) << diagnostics.ToString();
  EXPECT_GT(DistanceIn(*good, true), 1.2 * DistanceIn(*random, true));
}

TEST(PlanSplit, GivesApproachDirectionsWhereTheyDecide) {
  const ProblemSpec spec = Compliant();
  const Recording own = ReadExactly(spec, NarrowRows(40));
  const std::vector<Alternative> alternatives = {{Request("joint_compliance", 2)},
                                                 {Request("backlash", 2)}};
  SplitOptions options;
  options.candidates = 40;
  Diagnostics diagnostics;
  const auto plan = PlanSplit(spec, own, alternatives, options, &diagnostics);
  ASSERT_TRUE(plan.has_value()) << diagnostics.ToString();
  ASSERT_EQ(plan->rows.direction.rows(), 10);
  EXPECT_TRUE((plan->rows.direction.array().abs() == 1).all());
}

TEST(PlanSplit, RefusesWhatPosesCannotSteer) {
  const ProblemSpec spec = Compliant();
  const Recording own = ReadExactly(spec, NarrowRows(40));
  Diagnostics diagnostics;
  const std::vector<Alternative> alternatives = {{Request("joint_compliance", 2)},
                                                 {Request("joint_drift", 2)}};
  EXPECT_FALSE(PlanSplit(spec, own, alternatives, {}, &diagnostics).has_value());
  EXPECT_THAT(diagnostics.ToString(), testing::HasSubstr("nothing to split"));
}

TEST(AlternativesOf, KeepsSetsWhoseEffectsAllHaveNames) {
  const std::vector<HypothesisResult> hypotheses = {
      {{Request("joint_compliance", 2)}, 0.5, true},
      {{Request("something unnamed at theta2 driven by q2", 0)}, 0.5, true},
      {{}, 0.5, true},
      {{Request("backlash", 4)}, 0.5, false}};
  const std::vector<Alternative> alternatives = AlternativesOf(hypotheses);
  ASSERT_EQ(alternatives.size(), 1U);
  EXPECT_EQ(AlternativeName(alternatives[0]), "joint_compliance at joint 2");
}

}  // namespace
}  // namespace dhcal
