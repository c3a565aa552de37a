// Effects that load the bent arm, and rows that are set aside.
#include "problems/calibration.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/physics/registry.h"
#include "tests/support/matchers.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

// Forty times what a gear yields: the arm bends by some degrees.
constexpr double kSoft = 2e-4;  // [rad/(N m)]

/// The draw with effects of the file: estimated, or held at their values where they have some.
Draw DrawWithFileEffects(std::vector<EffectRequest> effects) {
  Draw draw = MakeDraw(Scenario(), 3);
  for (EffectRequest& effect : effects) effect.held = !effect.values.empty();
  draw.spec.parameters.effects = std::move(effects);
  return draw;
}

Eigen::VectorXd StateOf(const Calibration& c, double value) {
  return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(c.parameters.size()), value);
}

std::vector<int> RowsOfReadings(const std::vector<Reading>& readings) {
  std::vector<int> rows;
  for (const Reading& reading : readings) rows.push_back(reading.row_idx);
  return rows;
}

TEST(CalibrationBend, AHeldComplianceLoadsTheArmThatItBends) {
  const EffectRequest request = Request("joint_compliance", 2, {{"compliance", kSoft}});
  const Draw draw = DrawWithFileEffects({request});
  Calibration c(draw.spec, draw.recording);
  ASSERT_THAT(c.held, SizeIs(1));
  const Eigen::VectorXd nominal = c.held[0].weight;
  Eigen::MatrixXd arm(c.chain.slots().size(), draw.recording.num_rows());
  for (int row = 0; row < draw.recording.num_rows(); ++row) {
    arm.col(row) = c.SlotDeltas(StateOf(c, 0), row);
  }
  c.Bend(StateOf(c, 0));
  ASSERT_THAT(c.held, SizeIs(1));
  const Eigen::VectorXd bent = c.held[0].weight;
  EXPECT_GT((bent - nominal).lpNorm<Eigen::Infinity>(), 0.01 * nominal.lpNorm<Eigen::Infinity>());
  // The torque is that of the arm as it stood before.
  const PhysicsContext context(draw.spec.robot, draw.recording, {draw.spec.robot.X_WB}, arm);
  const std::vector<EffectColumn> columns = EffectColumns(context, request);
  ASSERT_THAT(columns, SizeIs(1));
  ASSERT_THAT(columns[0].slots, SizeIs(1));
  EXPECT_EQ(c.held[0].slot, columns[0].slots[0].slot);
  EXPECT_THAT(bent, MatrixNear(kSoft * columns[0].slots[0].weight, 1e-14));
}

TEST(CalibrationBend, ErrorsOfTheGeometryChangeTheLoadsToo) {
  const Draw draw = DrawWithFileEffects({Request("joint_compliance", 2, {{"compliance", 3e-6}})});
  Calibration c(draw.spec, draw.recording);
  c.Bend(StateOf(c, 0));
  const Eigen::VectorXd nominal = c.held[0].weight;
  c.Bend(StateOf(c, 5e-3));
  EXPECT_GT((c.held[0].weight - nominal).lpNorm<Eigen::Infinity>(),
            1e-4 * nominal.lpNorm<Eigen::Infinity>());
}

TEST(CalibrationBend, LeavesAnEffectAloneThatNoLoadDrives) {
  const Draw draw = DrawWithFileEffects({Request("joint_gain", 2, {{"gain", 0.05}})});
  Calibration c(draw.spec, draw.recording);
  ASSERT_THAT(c.held, SizeIs(1));
  const Eigen::VectorXd nominal = c.held[0].weight;
  c.Bend(StateOf(c, 0.01));
  ASSERT_THAT(c.held, SizeIs(1));
  EXPECT_EQ(c.held[0].weight, nominal);
}

TEST(CalibrationBend, AStateKeepsItsMeaning) {
  const Draw draw = DrawWithFileEffects(
      {Request("joint_compliance", 2), Request("joint_gain", 3, {{"gain", 1e-3}})});
  Calibration c(draw.spec, draw.recording);
  std::vector<std::string> before, after;
  for (const Parameter& p : c.parameters) before.push_back(p.name);
  c.Bend(StateOf(c, 1e-6));
  for (const Parameter& p : c.parameters) after.push_back(p.name);
  EXPECT_EQ(after, before);
  EXPECT_EQ(after.back(), "joint_compliance.2.compliance");
}

TEST(CalibrationSetAside, MarkedRowsAreInNoOtherReadings) {
  Draw draw = MakeDraw(Scenario(), 4);
  const auto rows = static_cast<std::size_t>(draw.recording.num_rows());
  draw.recording.is_test.assign(rows, false);
  for (const std::size_t row : {9, 10, 11}) draw.recording.is_test[row] = true;
  const Calibration all(draw.spec, draw.recording);
  EXPECT_THAT(all.readings.set_aside, IsEmpty());
  EXPECT_THAT(all.readings.fitted, SizeIs(rows - 3));

  draw.recording.set_aside.assign(rows, false);
  for (const std::size_t row : {5, 10}) draw.recording.set_aside[row] = true;
  const Calibration c(draw.spec, draw.recording);
  EXPECT_THAT(RowsOfReadings(c.readings.set_aside), ElementsAre(5, 10));
  EXPECT_THAT(RowsOfReadings(c.readings.test), ElementsAre(9, 11));
  const std::vector<int> fitted = RowsOfReadings(c.readings.fitted);
  EXPECT_THAT(fitted, SizeIs(rows - 4));
  EXPECT_EQ(std::count(fitted.begin(), fitted.end(), 5), 0);
}

TEST(CalibrationSetAside, NoMarkedRowChangesNothing) {
  Draw draw = MakeDraw(Scenario(), 4);
  draw.recording.set_aside.assign(static_cast<std::size_t>(draw.recording.num_rows()), false);
  const Calibration c(draw.spec, draw.recording);
  EXPECT_THAT(c.readings.set_aside, IsEmpty());
  EXPECT_EQ(static_cast<int>(c.readings.fitted.size()), draw.recording.num_rows());
}

TEST(CalibrationSetAside, ADifferenceOfSharedPosesLeadsOverTheGap) {
  Scenario scenario;
  scenario.kind = "adjacent_position";
  scenario.noise = NoiseKind::kSharedPose;
  Draw draw = MakeDraw(scenario, 4);
  draw.recording.set_aside.assign(static_cast<std::size_t>(draw.recording.num_rows()), false);
  draw.recording.set_aside[5] = true;
  const Calibration c(draw.spec, draw.recording);
  EXPECT_THAT(RowsOfReadings(c.readings.set_aside), ElementsAre(5));
  const auto after = std::find_if(c.readings.fitted.begin(),
                                  c.readings.fitted.end(),
                                  [](const Reading& reading) { return reading.row_idx == 6; });
  ASSERT_NE(after, c.readings.fitted.end());
  EXPECT_EQ(after->previous_idx, 4);
}

}  // namespace
}  // namespace dhcal
