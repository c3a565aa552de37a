// A drift whose time constant lies between those of the grid.
#include "problems/diagnosis/hypotheses/time_constants.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "problems/diagnosis/diagnose.h"
#include "problems/diagnosis/hypotheses/library.h"
#include "problems/diagnosis/refit/joint_fit.h"
#include "tests/support/problem_cases.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

constexpr double kPartOfDuration = 0.24;  // the grid has 0.19 and 0.3

/// The base moves `metres` along x, as much against y and half of it along z, in an exponential.
Draw Drifting(double metres) {
  Scenario scenario;
  scenario.poses = 150;
  Draw draw = MakeDraw(scenario, 3);
  Recording& recording = draw.recording;
  recording.time = 20 * Eigen::VectorXd::LinSpaced(scenario.poses, 0, scenario.poses - 1);
  const double constant = kPartOfDuration * recording.time.maxCoeff();
  const Eigen::RowVector3d motion(metres, -metres, metres / 2);
  for (int row = 0; row < scenario.poses; ++row) {
    recording.p_WQ.row(row) += motion * (1 - std::exp(-recording.time[row] / constant));
  }
  return draw;
}

TEST(TimeConstants, TheBestOneOfADriftFarAboveTheNoiseIsAdded) {
  const Draw draw = Drifting(1e-3);
  const JointModel model(draw.spec, draw.recording);
  RowChoice choice;
  choice.readings = model.calibration().readings.fitted;
  choice.weights.noise.sigma = draw.spec.measurement.sigma.value();
  const JointRows fit = FitJointly(model, model.Start(), choice, model.AllUnknowns(), kFarSteps);
  Bank bank(model, fit, NamedItems(*fit.context, LibraryOptions()), model.AllUnknowns());
  const std::size_t before = bank.items().size();
  AddTimeConstants(*fit.context, &bank);
  const Eigen::VectorXd gains = bank.Gains({});
  Eigen::Index best = 0;
  const double gain = gains.maxCoeff(&best);
  EXPECT_GE(static_cast<std::size_t>(best), before) << "none of the grid's is as good";
  const EffectRequest& found = bank.items()[static_cast<std::size_t>(best)].request;
  EXPECT_EQ(found.effect, "base_drift");
  EXPECT_NEAR(found.settings.at("time_constant_s") / fit.context->duration(),
              kPartOfDuration,
              0.05 * kPartOfDuration);
  EXPECT_GT(gain, gains.head(static_cast<Eigen::Index>(before)).maxCoeff() + 100);
}

TEST(TimeConstants, ADriftThirtyTimesTheNoiseKeepsItsName) {
  const Draw draw = Drifting(1e-3);
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  ASSERT_EQ(d.findings.size(), 1) << d.summary;
  EXPECT_EQ(d.findings[0].effect.effect, "base_drift") << d.summary;
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kExplained);
}

}  // namespace
}  // namespace dhcal
