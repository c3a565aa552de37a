// The rows that stand for a URDF's chain move the tip as the URDF does: judged by a walk through
// its text and by forward kinematics that are both written apart from the product.
#include "problems/formats/urdf/urdf_chain.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/kinematics/dh_chain.h"
#include "core/kinematics/dh_rows.h"
#include "problems/formats/urdf/urdf_new.h"
#include "tests/support/comma_locale.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/urdf_robots.h"
#include "tests/support/urdf_walk.h"

namespace dhcal {
namespace {

using Eigen::Matrix4d;
using Eigen::VectorXd;
using testing::HasSubstr;

constexpr double kTolerance = 1e-12;  // [m] and [rad]

RobotModel RobotOf(const UrdfRobot& robot) {
  Diagnostics diagnostics;
  const auto tree = ParseUrdf("arm.urdf", robot.text, &diagnostics);
  EXPECT_TRUE(tree) << diagnostics.ToString();
  if (!tree) return {};
  const auto chain = FindUrdfChain(*tree, {robot.base_link, robot.tip_link, {}, {}}, &diagnostics);
  EXPECT_TRUE(chain) << diagnostics.ToString();
  return chain ? RobotOfUrdf(*tree, *chain, &diagnostics) : RobotModel();
}

Matrix4d Forward(const RobotModel& robot, const VectorXd& q) {
  const VectorXd none = VectorXd::Zero(5 * q.size() + 12);
  return independent::ForwardKinematics<double>(robot, q, none);
}

VectorXd AnyJoints(std::size_t count, Rng* rng) {
  VectorXd q(static_cast<Eigen::Index>(count));
  for (double& number : q) number = rng->Uniform(-2.4, 2.4);
  return q;
}

UrdfWalk::Coordinates Named(const std::vector<std::string>& names, const VectorXd& q) {
  UrdfWalk::Coordinates named;
  for (std::size_t j = 0; j < names.size(); ++j) named[names[j]] = q[static_cast<Eigen::Index>(j)];
  return named;
}

double Difference(const Matrix4d& X, const Matrix4d& Y) { return (X - Y).cwiseAbs().maxCoeff(); }

class UrdfChainTest : public testing::TestWithParam<UrdfRobot> {};

TEST_P(UrdfChainTest, RowsOfBothConventionsMoveTheTipAsTheUrdfDoes) {
  const RobotModel standard = RobotOf(GetParam());
  const RobotModel modified = InConvention(standard, DhConvention::kModified);
  const RobotModel back = InConvention(modified, DhConvention::kStandard);
  ASSERT_EQ(modified.convention, DhConvention::kModified);
  ASSERT_EQ(back.convention, DhConvention::kStandard);
  const UrdfWalk walk(GetParam().text);
  Rng rng(1);
  for (int k = 0; k < 20; ++k) {
    const VectorXd q = AnyJoints(GetParam().joints.size(), &rng);
    const Matrix4d X =
        walk.Pose(GetParam().base_link, GetParam().tip_link, Named(GetParam().joints, q));
    EXPECT_LT(Difference(X, Forward(standard, q)), kTolerance);
    EXPECT_LT(Difference(X, Forward(modified, q)), kTolerance);
    EXPECT_LT(Difference(X, Forward(back, q)), kTolerance);
  }
}

TEST_P(UrdfChainTest, JointsKeepNamesAndLimits) {
  const RobotModel robot = RobotOf(GetParam());
  ASSERT_EQ(robot.joints.size(), GetParam().joints.size());
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    EXPECT_EQ(robot.joints[j].name, GetParam().joints[j]);
    EXPECT_GT(robot.joints[j].where.line, 1);
    const bool continuous = GetParam().text.find("name=\"" + GetParam().joints[j] +
                                                 "\" type=\"continuous\"") != std::string::npos;
    EXPECT_EQ(std::isinf(robot.joints[j].lower), continuous);
    EXPECT_TRUE(continuous || robot.joints[j].upper == 2.75);
  }
}

/// Both conventions, for the masses of a robot stay where they are.
TEST_P(UrdfChainTest, MassesAreWhereTheUrdfHasThem) {
  const UrdfRobot& urdf = GetParam();
  const UrdfWalk walk(urdf.text);
  Diagnostics diagnostics;
  const auto tree = ParseUrdf("arm.urdf", urdf.text, &diagnostics);
  ASSERT_TRUE(tree);
  const RobotModel standard = RobotOf(urdf);
  Rng rng(2);
  const VectorXd q = AnyJoints(urdf.joints.size(), &rng);
  // What the last joint carries, and what all do: sums of mass times place.
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  const std::string first = tree->joints.at(urdf.joints.front()).child;
  for (const auto& [name, link] : tree->links) {
    bool below = name == first;
    for (std::string up = name; !below && !tree->links.at(up).parent_joint.empty();) {
      up = tree->joints.at(tree->links.at(up).parent_joint).parent;
      below = up == first;
    }
    if (!below) continue;
    const Matrix4d X = walk.Pose(urdf.base_link, name, Named(urdf.joints, q));
    mass += link.inertial.mass;
    moment += link.inertial.mass * (X * link.inertial.p_LC.homogeneous()).head<3>();
  }
  for (const RobotModel& robot : {standard, InConvention(standard, DhConvention::kModified)}) {
    ASSERT_EQ(robot.links.size(), urdf.joints.size());
    const auto X_BL = DhChain(robot).LinkFrames(q);
    double sum = 0;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (std::size_t j = 0; j < robot.links.size(); ++j) {
      sum += robot.links[j].mass;
      place += robot.links[j].mass * (robot.X_WB * X_BL[j + 1] * robot.links[j].p_LC);
    }
    EXPECT_NEAR(sum, mass, 1e-12);
    EXPECT_LT((place - moment).norm() / mass, kTolerance);
    EXPECT_LT((robot.X_WB.linear() * robot.gravity_B - Eigen::Vector3d(0, 0, -9.80665)).norm(),
              kTolerance);
  }
}

TEST_P(UrdfChainTest, AUrdfMadeOfTheRowsMovesAsTheFirst) {
  const RobotModel robot = RobotOf(GetParam());
  const std::string made = UrdfOfRobot(robot, {"a -- remark"});
  Diagnostics diagnostics;
  const auto tree = ParseUrdf("made.urdf", made, &diagnostics);
  ASSERT_TRUE(tree) << diagnostics.ToString() << made;
  const auto chain = FindUrdfChain(*tree, {"", "tool0", {}, {}}, &diagnostics);
  ASSERT_TRUE(chain) << diagnostics.ToString();
  const RobotModel again = RobotOfUrdf(*tree, *chain, &diagnostics);
  const UrdfWalk first(GetParam().text), second(made);
  Rng rng(3);
  for (int k = 0; k < 5; ++k) {
    const VectorXd q = AnyJoints(GetParam().joints.size(), &rng);
    const auto named = Named(GetParam().joints, q);
    const Matrix4d X = first.Pose(GetParam().base_link, GetParam().tip_link, named);
    EXPECT_LT(Difference(X, second.Pose(tree->root, "tool0", named)), kTolerance);
    EXPECT_LT(Difference(X, Forward(again, q)), kTolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Robots,
                         UrdfChainTest,
                         testing::ValuesIn(AllUrdfs()),
                         [](const testing::TestParamInfo<UrdfRobot>& robot) {
                           return robot.param.name;
                         });

/// In the frame that the maker's table starts from: d1 0.1273, a2 -0.612, a3 -0.5723, d4 0.163941,
/// d5 0.1157, d6 0.0922, alpha 90, 0, 0, 90, -90, 0 deg.
TEST(UrdfRows, AreTheMakersTableOfTheUr10) {
  UrdfRobot ur10 = PublishedUrdfs().front();
  ur10.base_link = "base_link_inertia";
  const RobotModel robot = RobotOf(ur10);
  const std::vector<double> d = {0.1273, 0, 0, 0.163941, 0.1157, 0.0922};
  const std::vector<double> a = {0, -0.612, -0.5723, 0, 0, 0};
  const std::vector<double> alpha = {1, 0, 0, 1, -1, 0};
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_NEAR(robot.joints[j].d, d[j], 1e-9) << j;
    EXPECT_NEAR(robot.joints[j].a, a[j], 1e-9) << j;
    EXPECT_NEAR(robot.joints[j].theta, 0, 1e-9) << j;
    EXPECT_NEAR(robot.joints[j].alpha, alpha[j] * 1.5707963267948966, 1e-9) << j;
    EXPECT_EQ(robot.joints[j].beta, 0) << j;
  }
}

TEST(UrdfRows, OfNearlyParallelAxesStayShort) {
  for (const UrdfRobot& urdf : AllUrdfs()) {
    for (const JointRow& row : RobotOf(urdf).joints) {
      EXPECT_LT(std::abs(row.d), 100) << urdf.name << " " << row.name;
    }
  }
}

TEST(Urdf, IsReadUnderACommaLocale) {
  const RobotModel plain = RobotOf(PublishedUrdfs().front());
  const CommaLocale comma;
  const RobotModel robot = RobotOf(PublishedUrdfs().front());
  for (std::size_t j = 0; j < 6; ++j) EXPECT_EQ(robot.joints[j].a, plain.joints[j].a);
  EXPECT_EQ(UrdfOfRobot(robot, {}), UrdfOfRobot(plain, {}));
}

/// A text and what is said of it.
struct Wrong {
  std::string name, text, base_link, tip_link, said;
};

std::string TwoLinks(const std::string& joint) {
  return "<robot name=\"r\">\n  <link name=\"a\"/>\n  <link name=\"b\"/>\n" + joint +
         "\n</robot>\n";
}

std::string OneJoint(const std::string& type, const std::string& inside) {
  return TwoLinks("  <joint name=\"j\" type=\"" + type +
                  "\"><parent link=\"a\"/><child link=\"b\"/>" + inside + "</joint>");
}

class WrongUrdf : public testing::TestWithParam<Wrong> {};

TEST_P(WrongUrdf, IsRefusedWithPlaceAndRemedy) {
  Diagnostics diagnostics;
  const auto tree = ParseUrdf("arm.urdf", GetParam().text, &diagnostics);
  if (tree) {
    const SourceLocation where{"robot.yaml", 7, 3};
    EXPECT_FALSE(FindUrdfChain(
        *tree, {GetParam().base_link, GetParam().tip_link, where, where}, &diagnostics));
  }
  EXPECT_FALSE(diagnostics.ok());
  EXPECT_THAT(diagnostics.ToString(), HasSubstr(GetParam().said));
}

const char kLimit[] = "<limit lower=\"-1\" upper=\"1\" effort=\"0\" velocity=\"0\"/>";

INSTANTIATE_TEST_SUITE_P(
    Files,
    WrongUrdf,
    testing::Values(
        Wrong{"no_xml",
              "<robot name=\"r\">\n  <link name=\"a\">\n</robot>",
              "",
              "",
              "arm.urdf:3:3: error: this is no XML: Start-end tags mismatch"},
        Wrong{"no_robot",
              "<?xml version=\"1.0\"?>\n<sdf/>",
              "",
              "",
              "arm.urdf:2:1: error: the file's element is <sdf>, but a URDF's is <robot>"},
        Wrong{"xacro",
              "<robot name=\"r\">\n  <xacro:macro name=\"m\"/>\n</robot>",
              "",
              "",
              "arm.urdf:2:3: error: <xacro:macro> holds a macro of xacro; make the URDF of it"},
        Wrong{"number",
              OneJoint("revolute", "<origin xyz=\"0 0,1 0\"/>" + std::string(kLimit)),
              "",
              "",
              "arm.urdf:4:3: error: ROS cannot read this URDF either"},
        Wrong{"floating",
              OneJoint("floating", ""),
              "a",
              "b",
              "arm.urdf:4:3: error: joint 'j' is floating: it has no one axis"},
        Wrong{"planar",
              OneJoint("planar", ""),
              "a",
              "b",
              "arm.urdf:4:3: error: joint 'j' is planar: it has no one axis"},
        Wrong{"mimic",
              OneJoint("revolute", kLimit + std::string("<mimic joint=\"k\" multiplier=\"2\"/>")),
              "a",
              "b",
              "arm.urdf:4:3: error: joint 'j' mimics joint 'k'"},
        Wrong{"no_axis",
              OneJoint("revolute", kLimit + std::string("<axis xyz=\"0 0 0\"/>")),
              "a",
              "b",
              "arm.urdf:4:3: error: joint 'j' has an <axis> of length zero"},
        Wrong{"two_parents",
              TwoLinks("<link name=\"c\"/>"
                       "<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/>"
                       "</joint>\n<joint name=\"k\" type=\"fixed\"><parent link=\"c\"/>"
                       "<child link=\"b\"/></joint>"),
              "",
              "",
              "arm.urdf"},
        Wrong{"no_such_link",
              OneJoint("continuous", ""),
              "a",
              "bb",
              "robot.yaml:7:3: error: arm.urdf has no link 'bb'; did you mean 'b'?"},
        Wrong{"wrong_way",
              OneJoint("continuous", ""),
              "b",
              "a",
              "link 'a' is not below link 'b' in arm.urdf; exchange base_link and tip_link"},
        Wrong{"nothing_moves",
              OneJoint("fixed", ""),
              "",
              "",
              "no joint moves between the links 'a' and 'b'"}),
    [](const testing::TestParamInfo<Wrong>& wrong) { return wrong.param.name; });

TEST(Urdf, SaysWhereTheChainMayEndWhereItBranches) {
  Diagnostics diagnostics;
  const auto tree = ParseUrdf("arm.urdf",
                              TwoLinks("<link name=\"c\"/>"
                                       "<joint name=\"j\" type=\"continuous\"><parent link=\"a\"/>"
                                       "<child link=\"b\"/></joint>"
                                       "<joint name=\"k\" type=\"fixed\"><parent link=\"a\"/>"
                                       "<child link=\"c\"/></joint>"),
                              &diagnostics);
  ASSERT_TRUE(tree);
  EXPECT_FALSE(FindUrdfChain(*tree, {}, &diagnostics));
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("tip_link: 'b' or 'c'"));
}

}  // namespace
}  // namespace dhcal
