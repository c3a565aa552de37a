#include "core/model/robot.h"

#include <gtest/gtest.h>

namespace dhcal {
namespace {

TEST(JointWords, HaveTheNameOfTheFileWhereItSaysMoreThanTheNumber) {
  RobotModel robot;
  robot.joints.resize(5);
  robot.joints[0].name = "rail_x";
  robot.joints[1].name = "A2";
  robot.joints[2].name = "A2";
  robot.joints[3].name = "joint_4";
  EXPECT_EQ(JointWords(robot, 1), "joint 1 (rail_x)");
  EXPECT_EQ(JointWords(robot, 2), "joint 2");
  EXPECT_EQ(JointWords(robot, 3), "joint 3 (A2)");
  EXPECT_EQ(JointWords(robot, 4), "joint 4");
  EXPECT_EQ(JointWords(robot, 5), "joint 5");
  EXPECT_EQ(JointWords(robot, 9), "joint 9");
}

}  // namespace
}  // namespace dhcal
