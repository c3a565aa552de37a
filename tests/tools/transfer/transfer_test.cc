// Physics that was found holds for rows, and recordings, that were not fitted.
#include "tools/transfer/transfer.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/prediction.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

Draw CompliantDraw(std::uint64_t seed) {
  Scenario scenario;
  scenario.truth = {Request("joint_compliance", 2, {{"compliance", 3e-6}})};
  return MakeDraw(scenario, seed);
}

double Rms(const ProblemSpec& spec, const Recording& recording) {
  const auto fit = FitComplete(spec, recording, {}, {});
  EXPECT_TRUE(fit->usable());
  return Statistics(fit->calibration, fit->state(), fit->calibration.readings.fitted).rms;
}

TEST(HeldEffect, AtItsTrueValuesLeavesTheNoise) {
  Draw draw = CompliantDraw(1);
  const double sigma = draw.spec.measurement.sigma.value();
  EXPECT_GT(Rms(draw.spec, draw.recording), 2 * sigma);
  draw.spec.parameters.effects = {Request("joint_compliance", 2, {{"compliance", 3e-6}})};
  draw.spec.parameters.effects[0].held = true;
  EXPECT_LT(Rms(draw.spec, draw.recording), 1.1 * sigma);
}

TEST(HeldEffect, IsNoUnknown) {
  Draw draw = CompliantDraw(1);
  draw.spec.parameters.effects = {Request("joint_compliance", 2, {{"compliance", 3e-6}})};
  draw.spec.parameters.effects[0].held = true;
  const Calibration c(draw.spec, draw.recording);
  EXPECT_TRUE(c.effect_columns.empty());
  EXPECT_FALSE(c.held.empty());
}

TEST(ConsecutiveBlocks, AreInOrderAndOfEqualSize) {
  const std::vector<int> fold = ConsecutiveBlocks(23, 5);
  EXPECT_TRUE(std::is_sorted(fold.begin(), fold.end()));
  for (int block = 0; block < 5; ++block) {
    const auto size = std::count(fold.begin(), fold.end(), block);
    EXPECT_TRUE(size == 4 || size == 5) << block;
  }
}

TEST(PredictBlocks, ImprovesEveryBlockByWhatWasLeftOut) {
  const Draw draw = CompliantDraw(2);
  const auto errors = PredictBlocks(
      draw.spec, draw.recording, {Request("joint_compliance", 2, {{"compliance", 3e-6}})}, 3, {});
  ASSERT_EQ(errors.size(), 4);
  for (const Errors& block : errors) EXPECT_LT(block.after, 0.5 * block.before);
}

// Each series of shared poses has a row more than it has differences.
TEST(PredictBlocks, OfSharedPosesAreOfTheirOwnRows) {
  Scenario scenario;
  scenario.kind = "adjacent_position";
  scenario.noise = NoiseKind::kSharedPose;
  scenario.runs = 10;
  Draw draw = MakeDraw(scenario, 4);
  // Only the last of two blocks is bad.
  const int n = draw.recording.num_rows();
  Rng rng(8);
  for (int row = n / 2; row < n; ++row) {
    for (int k = 0; k < 3; ++k) draw.recording.p_WQ(row, k) += 1e-3 * rng.Normal();
  }
  const auto errors = PredictBlocks(draw.spec, draw.recording, {}, 2, {});
  ASSERT_EQ(errors.size(), 3);
  EXPECT_EQ(errors[0].rows, n / 2);
  EXPECT_EQ(errors[1].rows, n / 2);
  EXPECT_EQ(errors[2].rows, n);
  EXPECT_GT(errors[1].after, 0.8e-3 * std::sqrt(3.0));
}

TEST(TransferTo, CarriesPhysicsButNoInstantsToAnotherRecording) {
  const Draw first = CompliantDraw(3), second = CompliantDraw(3);
  EffectRequest step;
  step.effect = "joint_step";
  step.joint = 1;
  step.settings["at_row"] = 50;
  step.values["step"] = 1e-3;
  const Transfer transfer =
      TransferTo(second.spec,
                 second.recording,
                 first.recording,
                 {Request("joint_compliance", 2, {{"compliance", 3e-6}}), step},
                 {});
  EXPECT_EQ(transfer.left_behind.size(), 1);
  EXPECT_LT(transfer.all.after, 0.5 * transfer.all.before);
  EXPECT_EQ(transfer.inside.rows + transfer.outside.rows, transfer.all.rows);
  EXPECT_EQ(transfer.visited.rows, transfer.all.rows);
}

}  // namespace
}  // namespace dhcal
