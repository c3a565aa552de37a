// A part that has a name beside a larger part, at the same joint, that has none.
#include "problems/diagnosis/judge/doubtful.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/diagnosis/hypotheses/cells.h"
#include "problems/diagnosis/hypotheses/library.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class DoubtfulTest : public ::testing::Test {
 protected:
  DoubtfulTest() : draw_(MakeDraw(Scenario(), 7)), model_(draw_.spec, draw_.recording) {}

  void AddEffect(const EffectRequest& request, double value) {
    Member member;
    member.item = NamedItem(model_.calibration().Context(), request, 1);
    member.value = Eigen::VectorXd::Constant(member.item.size, value);
    members_.push_back(member);
  }

  void AddCell(const std::string& id, double value) {
    const std::vector<Item> cells = CellItems(model_.calibration().Context());
    const auto found =
        std::find_if(cells.begin(), cells.end(), [&](const Item& item) { return item.id == id; });
    ASSERT_NE(found, cells.end()) << id;
    members_.push_back({*found, Eigen::VectorXd::Constant(found->size, value)});
  }

  std::vector<int> Doubtful() const {
    JointState state = model_.Start();
    state.members = members_;
    RowChoice choice;
    choice.readings = model_.calibration().readings.fitted;
    choice.weights.noise.sigma = draw_.spec.measurement.sigma.value();
    return DoubtfulMembers(model_.At(state, choice, model_.AllUnknowns()));
  }

  Draw draw_;
  JointModel model_;
  std::vector<Member> members_;
};

TEST_F(DoubtfulTest, ALineBesideALargerUnnamedPartOfItsJoint) {
  AddEffect(Request("gear_harmonic", 4, {}, {{"order", 1}}), 1e-4);
  AddCell("theta4 x q6", 3e-4);
  EXPECT_THAT(Doubtful(), ElementsAre(0));
}

TEST_F(DoubtfulTest, ALineThatMovesFarMoreThanWhatHasNoName) {
  AddEffect(Request("gear_harmonic", 4, {}, {{"order", 1}}), 1e-3);
  AddCell("theta4 x q6", 1e-5);
  EXPECT_THAT(Doubtful(), IsEmpty());
}

TEST_F(DoubtfulTest, WhatItsAngleDrivesElsewhereCounts) {
  AddEffect(Request("axis_wobble", 6, {}, {{"order", 2}}), 1e-4);
  AddCell("theta4 x q6", 1e-3);
  EXPECT_THAT(Doubtful(), ElementsAre(0));
}

TEST_F(DoubtfulTest, AnotherJointsRestAndOtherDriversDoNot) {
  AddEffect(Request("gear_harmonic", 1, {}, {{"order", 1}}), 1e-4);
  AddEffect(Request("joint_compliance", 4), 1e-6);
  AddCell("theta4 x q6", 1e-3);
  EXPECT_THAT(Doubtful(), IsEmpty());
}

TEST_F(DoubtfulTest, WithoutItsNameAMemberHasTheSameColumns) {
  const PhysicsContext context = model_.calibration().Context();
  const Item named = NamedItem(context, Request("gear_harmonic", 4, {}, {{"order", 2}}), 1);
  const Item cell = Unnamed(named, context);
  EXPECT_FALSE(cell.is_name());
  EXPECT_EQ(cell.slot, "theta4");
  EXPECT_EQ(cell.driver, "q4");
  const SlotColumns before = ColumnsOf(named, context), after = ColumnsOf(cell, context);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    ASSERT_EQ(before[k].size(), after[k].size());
    for (std::size_t i = 0; i < before[k].size(); ++i) {
      EXPECT_EQ(before[k][i].slot, after[k][i].slot);
      EXPECT_EQ(before[k][i].weight, after[k][i].weight);
    }
  }
}

}  // namespace
}  // namespace dhcal
