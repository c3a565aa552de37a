// A fit with curves that starts near another one ends where the one from the start does.
#include "problems/diagnosis/complete_fit.h"

#include <gtest/gtest.h>

#include "problems/prediction.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

Draw DrawWithALineAndACompliance() {
  Scenario scenario;
  scenario.poses = 400;
  scenario.truth = {Request("gear_harmonic", 3, {{"sin_17", 3e-4}}, {{"order", 17}}),
                    Request("joint_compliance", 2, {{"compliance", 3e-6}})};
  return MakeDraw(scenario, 4);
}

double RmsOf(const CompleteFit& fit) {
  return Statistics(fit.calibration, fit.state(), fit.calibration.readings.fitted).rms;
}

TEST(FitCompleteWithCurves, DoesNotDependOnWhereItStarts) {
  const Draw draw = DrawWithALineAndACompliance();
  const std::vector<EffectRequest> effects = {Request("transmission_error", 3),
                                              Request("joint_compliance", 2)};
  const auto geometry = FitComplete(draw.spec, draw.recording, {}, {});
  const auto cold = FitComplete(draw.spec, draw.recording, effects, {});
  const auto near = FitComplete(draw.spec, draw.recording, effects, {}, geometry.get());
  ASSERT_TRUE(cold->usable());
  ASSERT_TRUE(near->usable());
  const double sigma = draw.spec.measurement.sigma.value();
  EXPECT_GT(RmsOf(*geometry), 3 * sigma);
  EXPECT_LT(RmsOf(*cold), 1.05 * sigma);
  EXPECT_NEAR(RmsOf(*near), RmsOf(*cold), 1e-3 * sigma);
  EXPECT_LT((near->state() - cold->state()).norm(), 1e-3 * cold->state().norm());
}

TEST(FitCompleteWithCurves, FindsTheNoiseWhereItIsNotGiven) {
  Draw draw = DrawWithALineAndACompliance();
  const double sigma = draw.spec.measurement.sigma.value();
  draw.spec.measurement.sigma.reset();
  const auto fit = FitComplete(draw.spec,
                               draw.recording,
                               {Request("transmission_error", 3), Request("joint_compliance", 2)},
                               {});
  ASSERT_TRUE(fit->usable());
  EXPECT_NEAR(fit->fit.noise_seen.sigma, sigma, 0.1 * sigma);
}

}  // namespace
}  // namespace dhcal
