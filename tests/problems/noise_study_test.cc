// The promises of the statistics, measured over noise draws. The Slow tests give the figures that
// README quotes; run them with `tools/test.sh --slow`.

#include "tests/support/noise_study.h"

#include <iostream>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/problem_cases.h"

namespace dhcal {
namespace {

/// kr15_noisy with another noise [m], known to the solver.
ProblemSpec WithNoise(double sigma) {
  ProblemSpec spec = LoadCase("kr15_noisy");
  spec.simulate->noise = sigma;
  spec.measurement.sigma = sigma;
  return spec;
}

ProblemSpec WithPriors(ProblemSpec spec) {
  for (const char* const group : {"theta", "alpha"}) {
    spec.parameters.prior_sigma[group] = 1 * kMilliradian;
  }
  for (const char* const group : {"a", "d"}) spec.parameters.prior_sigma[group] = 1e-4;
  return spec;
}

void Print(const char* what, const NoiseStudy& study) {
  std::cout << what << ": coverage " << 100 * study.coverage << " % of " << study.num_intervals
            << " intervals, median 3-D RMS error at new poses in the joint ranges "
            << study.median_prediction * 1e6 << " um, over full turns "
            << study.median_full_turns * 1e6 << " um\n";
}

TEST(NoiseStudy, IntervalsCoverAndPredictionsHoldInFewDraws) {
  const NoiseStudy study = RunNoiseStudy(WithNoise(10e-6), 20);
  EXPECT_EQ(study.num_failed, 0);
  EXPECT_GT(study.num_intervals, 200);
  // 20 draws of about 17 correlated intervals: three sigmas of the binomial, doubled.
  EXPECT_GT(study.coverage, 0.87);
  EXPECT_LT(study.median_prediction, 130e-6);
}

TEST(NoiseStudySlow, NinetyFivePercentIntervalsCoverNinetyFourToNinetySix) {
  for (const double sigma : {10e-6, 20e-6}) {
    const NoiseStudy known = RunNoiseStudy(WithNoise(sigma), 1000);
    Print("sigma known", known);
    EXPECT_GE(known.coverage, 0.94);
    EXPECT_LE(known.coverage, 0.96);
    ProblemSpec spec = WithNoise(sigma);
    spec.measurement.sigma.reset();
    const NoiseStudy estimated = RunNoiseStudy(spec, 1000);
    Print("sigma estimated", estimated);
    EXPECT_GE(estimated.coverage, 0.94);
    EXPECT_LE(estimated.coverage, 0.96);
  }
}

TEST(NoiseStudySlow, PredictionsAtNewPosesReachTheOptimum) {
  const NoiseStudy plain = RunNoiseStudy(WithNoise(10e-6), 200);
  Print("noise rule", plain);
  // Over full turns, which the arm's stops do not allow, it is 101.8 um: the figure depends on the
  // poses, which the bar does not state.
  EXPECT_LE(plain.median_prediction, 96e-6);

  ProblemSpec relative = WithNoise(10e-6);
  relative.solver.rule = TruncationRule::kRelative;
  relative.solver.relative_tolerance = 1e-6;
  Print("relative 1e-6", RunNoiseStudy(relative, 200));

  const NoiseStudy prior = RunNoiseStudy(WithPriors(WithNoise(10e-6)), 200);
  Print("priors 1 mrad, 0.1 mm", prior);
  EXPECT_LE(prior.median_prediction, 80e-6);
}

}  // namespace
}  // namespace dhcal
