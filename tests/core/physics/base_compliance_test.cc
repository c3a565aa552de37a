// A base turns about the axes that gravity can turn it about, however the robot is mounted.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/physics/gravity.h"
#include "core/physics/registry.h"
#include "core/physics/worked_example.h"

namespace dhcal {
namespace {

using testing::ElementsAre;

class BaseUnderGravity : public testing::Test {
 protected:
  BaseUnderGravity() {
    Rng rng(4);
    rows_.q.resize(40, 6);
    for (double& q : rows_.q.reshaped()) q = rng.Uniform(-2, 2);
  }
  std::vector<EffectColumn> Columns() const {
    const PhysicsContext context(robot_, rows_, {robot_.X_WB});
    EffectRequest request;
    request.effect = "base_compliance";
    return EffectColumns(context, request);
  }
  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const EffectColumn& column : Columns()) names.push_back(column.parameter);
    return names;
  }
  RobotModel robot_ = WorkedExampleRobot();
  Recording rows_;
};

TEST_F(BaseUnderGravity, TurnsAboutXAndYWhereItStandsOrHangs) {
  robot_.gravity_B = {0, 0, -9.80665};
  EXPECT_THAT(Names(), ElementsAre("compliance_x", "compliance_y"));
  robot_.gravity_B = {0.2, -0.1, 9.8};
  EXPECT_THAT(Names(), ElementsAre("compliance_x", "compliance_y"));
}

TEST_F(BaseUnderGravity, TurnsAboutTheTwoOthersOnAWall) {
  robot_.gravity_B = {9.80665, 0, -6e-16};
  EXPECT_THAT(Names(), ElementsAre("compliance_y", "compliance_z"));
  robot_.gravity_B = {0, -9.80665, 1e-15};
  EXPECT_THAT(Names(), ElementsAre("compliance_x", "compliance_z"));
  // What is left out would be rounding, and no column is.
  for (const EffectColumn& column : Columns()) {
    double largest = 0;
    for (const SlotWeights& slot : column.slots) {
      largest = std::max(largest, slot.weight.cwiseAbs().maxCoeff());
    }
    EXPECT_GT(largest, 1) << column.parameter;
  }
}

TEST_F(BaseUnderGravity, OfASmallArmIsSofterByAsMuchAsItsTorquesAreSmaller) {
  const auto softness = [&] {
    return SoftnessOfSize(PhysicsContext(robot_, rows_, {robot_.X_WB}));
  };
  EXPECT_EQ(softness(), 1);
  const double typical = Columns()[0].typical;
  for (LinkMass& link : robot_.links) link.mass *= 1e-3;
  EXPECT_GT(softness(), 50);
  EXPECT_DOUBLE_EQ(Columns()[0].typical, typical * softness());
  robot_.links.clear();
  EXPECT_EQ(softness(), 1);
}

}  // namespace
}  // namespace dhcal
