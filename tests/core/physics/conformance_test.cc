// What every effect of the library must hold, in a loop over the registry: a new effect is tested
// without a new line here.
#include <cmath>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/physics/registry.h"
#include "core/physics/worked_example.h"
#include "tests/core/physics/physics_page.h"

namespace dhcal {
namespace {

class EffectConformance : public testing::TestWithParam<const Effect*> {
 protected:
  EffectConformance()
      : robot_(WorkedExampleRobot()),
        recording_(WorkedExampleRecording()),
        context_(robot_, recording_, {robot_.X_WB}) {}

  const Effect& effect() const { return *GetParam(); }

  /// What a request with values adds to a slot at a row.
  double Delta(const EffectRequest& request, const std::string& slot, int row) const {
    double delta = 0;
    for (const EffectColumn& column : effect().Columns(context_, request)) {
      const auto value = request.values.find(column.parameter);
      if (value == request.values.end()) continue;
      for (const SlotWeights& weights : column.slots) {
        if (context_.slots().Name(weights.slot) == slot) {
          delta += weights.weight[row] * value->second;
        }
      }
    }
    return delta;
  }

  RobotModel robot_;
  Recording recording_;
  PhysicsContext context_;
};

TEST_P(EffectConformance, DescribesItselfWithUnitsAndASource) {
  const EffectDescription d = effect().Describe();
  EXPECT_FALSE(d.name.empty());
  EXPECT_THAT(d.summary, testing::SizeIs(testing::Gt(10)));
  EXPECT_FALSE(d.formula.empty());
  EXPECT_THAT(d.parameters, testing::HasSubstr("["));
  const std::set<std::string> cited = CitedSections(d.typical);
  EXPECT_FALSE(cited.empty()) << d.typical;
  for (const std::string& label : cited) {
    EXPECT_TRUE(PhysicsPage().HasSection(label)) << "PHYSICS.md has no section " << label;
  }
}

TEST_P(EffectConformance, ThePhysicsPageListsItsSectionsAndClasses) {
  const EffectDescription d = effect().Describe();
  const PhysicsPage page;
  const PhysicsRow row = page.Row(d.name);
  EXPECT_EQ(row.sections, CitedSections(d.typical));
  std::vector<EffectRequest> requests = effect().Candidates(context_);
  requests.push_back(effect().Example().request);
  for (const EffectRequest& request : requests) {
    const std::string effect_class = effect().Place(context_, request).effect_class;
    EXPECT_EQ(row.classes.count(effect_class), 1) << effect_class << " " << InstanceName(request);
    const bool numbered = std::regex_match(effect_class, std::regex("C[0-9]+"));
    EXPECT_TRUE(!numbered || page.HasSection(effect_class)) << effect_class;
  }
}

TEST_P(EffectConformance, DependsOnThePoseAloneWhereItSaysSo) {
  Recording bare;
  bare.q = recording_.q.colwise().reverse();
  if (recording_.payload.size() > 0) bare.payload = recording_.payload.reverse();
  const PhysicsContext bare_context(robot_, bare, {robot_.X_WB});
  for (const EffectRequest& request : effect().Candidates(context_)) {
    if (!effect().DependsOnPoseOnly(request)) continue;
    if (!effect().NotTestable(context_, request).empty()) continue;
    ASSERT_EQ(effect().NotTestable(bare_context, request), "") << InstanceName(request);
    const auto columns = effect().Columns(context_, request);
    const auto bare_columns = effect().Columns(bare_context, request);
    ASSERT_EQ(columns.size(), bare_columns.size()) << InstanceName(request);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      ASSERT_EQ(columns[k].slots.size(), bare_columns[k].slots.size());
      for (std::size_t i = 0; i < columns[k].slots.size(); ++i) {
        const Eigen::VectorXd& weight = columns[k].slots[i].weight;
        EXPECT_LT((weight - bare_columns[k].slots[i].weight.reverse()).norm(),
                  1e-12 * (1 + weight.norm()))
            << InstanceName(request);
      }
    }
  }
}

TEST_P(EffectConformance, ReproducesItsWorkedNumber) {
  const WorkedExample example = effect().Example();
  ASSERT_EQ(effect().NotTestable(context_, example.request), "");
  EXPECT_NEAR(Delta(example.request, example.slot, example.row),
              example.expected,
              1e-9 * std::abs(example.expected));
}

TEST_P(EffectConformance, ParametersAreTheOnesItsExampleNames) {
  const WorkedExample example = effect().Example();
  std::set<std::string> names;
  for (const EffectColumn& column : effect().Columns(context_, example.request)) {
    EXPECT_TRUE(names.insert(column.parameter).second) << column.parameter << " comes twice";
    EXPECT_FALSE(column.unit.empty());
    EXPECT_GT(column.typical, 0);
  }
  for (const auto& [name, value] : example.request.values) EXPECT_EQ(names.count(name), 1) << name;
}

TEST_P(EffectConformance, WeightsAreFiniteForEveryRowAndSlot) {
  for (const EffectRequest& request : effect().Candidates(context_)) {
    if (!effect().NotTestable(context_, request).empty()) continue;
    for (const EffectColumn& column : effect().Columns(context_, request)) {
      ASSERT_FALSE(column.slots.empty());
      for (const SlotWeights& weights : column.slots) {
        EXPECT_GE(weights.slot, 0);
        EXPECT_LT(weights.slot, context_.slots().size());
        ASSERT_EQ(weights.weight.size(), context_.num_rows());
        EXPECT_TRUE(weights.weight.allFinite());
      }
    }
  }
}

TEST_P(EffectConformance, SaysWhereItSitsAndPutsItsSizeIntoWords) {
  const WorkedExample example = effect().Example();
  const EffectPlace place = effect().Place(context_, example.request);
  EXPECT_FALSE(place.effect_class.empty());
  EXPECT_FALSE(place.location.empty());
  EXPECT_FALSE(place.driver.empty());
  std::vector<EffectValue> values;
  for (const EffectColumn& column : effect().Columns(context_, example.request)) {
    values.push_back({column.parameter, column.unit, 2 * column.typical, column.typical});
  }
  EXPECT_THAT(effect().Sentence(context_, example.request, values), testing::HasSubstr("+-"));
}

TEST_P(EffectConformance, IsNotTestableOnARobotThatNeverMoves) {
  Recording still;
  still.q = Eigen::MatrixXd::Zero(5, 6);
  const PhysicsContext context(robot_, still, {robot_.X_WB});
  // Constant geometry and the instrument's scale need no motion, steps only an order.
  const std::string name = effect().Describe().name;
  const std::set<std::string> needs_none = {"axis_tilt",
                                            "base_frame",
                                            "tool_offset",
                                            "sensor_scale",
                                            "joint_step",
                                            "tool_step",
                                            "base_step"};
  if (needs_none.count(name) > 0) return;
  for (const EffectRequest& request : effect().Candidates(context)) {
    EXPECT_NE(effect().NotTestable(context, request), "") << InstanceName(request);
  }
}

std::string NameOf(const testing::TestParamInfo<const Effect*>& param) {
  return param.param->Describe().name;
}

INSTANTIATE_TEST_SUITE_P(Library, EffectConformance, testing::ValuesIn(AllEffects()), NameOf);

TEST(Registry, NamesAreUniqueAndFound) {
  std::set<std::string> names;
  for (const std::string& name : EffectNames()) {
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_NE(FindEffect(name), nullptr);
  }
  EXPECT_EQ(FindEffect("no_such_effect"), nullptr);
}

TEST(Registry, HoldsEveryEffectOfTheFormats) {
  for (const char* const name : {"joint_compliance",  "torsion_nonlinearity", "gravity_balancer",
                                 "link_bending",      "base_compliance",      "joint_gain",
                                 "gear_harmonic",     "joint_coupling",       "backlash",
                                 "axis_wobble",       "link_thermal",         "base_drift",
                                 "joint_drift",       "joint_step",           "tool_step",
                                 "latency",           "sensor_scale",         "axis_tilt",
                                 "base_frame",        "tool_offset",          "edge_bow",
                                 "edge_misalignment", "laser_linearity",      "laser_tilt",
                                 "camera_scale",      "camera_abbe"}) {
    EXPECT_NE(FindEffect(name), nullptr) << name;
  }
}

}  // namespace
}  // namespace dhcal
