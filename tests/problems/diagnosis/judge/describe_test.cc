// What makes one finding.
#include "problems/diagnosis/judge/describe.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/diagnosis/hypotheses/library.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

using ::testing::ElementsAre;
using Groups = std::vector<std::vector<int>>;

Groups GroupsOf(const std::vector<EffectRequest>& requests) {
  const Draw draw = MakeDraw(Scenario(), 8);
  const JointModel model(draw.spec, draw.recording);
  std::vector<Member> members;
  for (const EffectRequest& request : requests) {
    Member member;
    member.item = NamedItem(model.calibration().Context(), request, 1);
    members.push_back(member);
  }
  return FindingGroups(members);
}

EffectRequest Line(int joint, double order) {
  return Request("gear_harmonic", joint, {}, {{"order", order}});
}

TEST(FindingGroupsTest, AGainBesideACurveOfItsJointIsPartOfTheCurve) {
  EXPECT_THAT(GroupsOf({Request("joint_gain", 1),
                        Request("joint_compliance", 2),
                        Request("transmission_error", 1, {}, {{"knot_deg", 45}})}),
              ElementsAre(ElementsAre(1), ElementsAre(0, 2)));
}

TEST(FindingGroupsTest, AGainBesideASeriesOfLinesIsPartOfIt) {
  EXPECT_THAT(GroupsOf({Line(1, 1), Request("joint_gain", 1), Line(1, 2), Line(1, 3)}),
              ElementsAre(ElementsAre(0, 1, 2, 3)));
}

TEST(FindingGroupsTest, AGainBesideOneLineIsAFindingOfItsOwn) {
  EXPECT_THAT(GroupsOf({Line(1, 1), Request("joint_gain", 1)}),
              ElementsAre(ElementsAre(0), ElementsAre(1)));
}

TEST(FindingGroupsTest, AnotherJointsGainAndAnAxisThatWobblesStayApart) {
  EXPECT_THAT(GroupsOf({Request("transmission_error", 1, {}, {{"knot_deg", 45}}),
                        Request("joint_gain", 2),
                        Request("axis_wobble", 1, {}, {{"order", 2}})}),
              ElementsAre(ElementsAre(0), ElementsAre(1), ElementsAre(2)));
}

}  // namespace
}  // namespace dhcal
