// A calibrated robot written into its URDF: it moves as the calibrated rows do, every link's frame
// keeps its place on the physical link, and nothing but the joints' origins has changed.
#include "problems/formats/urdf/urdf_corrected.h"

#include <cstddef>
#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/kinematics/dh_rows.h"
#include "core/model/joint_numbers.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/temp_folder.h"
#include "tests/support/urdf_robots.h"
#include "tests/support/urdf_walk.h"

namespace dhcal {
namespace {

using Eigen::Matrix4d;
using Eigen::VectorXd;
using testing::HasSubstr;

constexpr double kLinkTolerance = 1e-12;  // [m] and [rad]

/// A URDF as read, and its rows with errors.
struct UrdfCase {
  UrdfTree tree;
  UrdfChain chain;
  RobotModel nominal, calibrated;  // modified: whose rows end on the joints' axes
};

UrdfCase UrdfCaseOf(const UrdfRobot& robot) {
  Diagnostics diagnostics;
  UrdfCase c;
  c.tree = ParseUrdf("arm.urdf", robot.text, &diagnostics).value();
  c.chain = FindUrdfChain(c.tree, {robot.base_link, robot.tip_link, {}, {}}, &diagnostics).value();
  c.nominal = InConvention(RobotOfUrdf(c.tree, c.chain, &diagnostics), DhConvention::kModified);
  c.calibrated = c.nominal;
  Rng rng(7);
  for (JointRow& row : c.calibrated.joints) {
    for (const JointNumber& number : kJointNumbers) row.*number.value += rng.Uniform(-2e-3, 2e-3);
  }
  return c;
}

std::string Corrected(const UrdfCase& c, const std::vector<std::string>& remarks = {}) {
  Diagnostics diagnostics;
  const auto text = CorrectedUrdf(c.tree, c.chain, c.calibrated, remarks, &diagnostics);
  EXPECT_TRUE(text) << diagnostics.ToString();
  return text.value_or("");
}

/// Frame of the first `count` modified rows.
Matrix4d FrameOf(const RobotModel& robot, const VectorXd& q, Eigen::Index count) {
  RobotModel first = robot;
  first.joints.resize(static_cast<std::size_t>(count));
  return independent::ForwardKinematics<double>(first,
                                                q.head(count),
                                                VectorXd::Zero(5 * count + 12),
                                                robot.X_WB,
                                                Eigen::Isometry3d::Identity());
}

/// Without the joints' own origins and what was put before <robot>.
std::string Rest(const std::string& text) {
  std::string rest;
  std::string body = text.substr(text.find("<robot"));
  for (std::size_t k = body.find("<joint "); k != std::string::npos; k = body.find("<joint ")) {
    const std::size_t end = body.find("</joint>", k);
    rest += body.substr(0, k);
    rest += std::regex_replace(body.substr(k, end - k), std::regex("\\s*<origin\\b[^>]*>"), "");
    body.erase(0, end);
  }
  return rest + body;
}

class UrdfCorrectedTest : public testing::TestWithParam<UrdfRobot> {};

TEST_P(UrdfCorrectedTest, LinksKeepTheirPlaceOnTheRowsAndTheTipMovesAsCalibrated) {
  const UrdfCase c = UrdfCaseOf(GetParam());
  const UrdfWalk before(GetParam().text), after(Corrected(c));
  Rng rng(8);
  const auto n = static_cast<Eigen::Index>(c.chain.joints.size());
  for (int k = 0; k < 10; ++k) {
    VectorXd q(n);
    UrdfWalk::Coordinates named;
    for (Eigen::Index j = 0; j < n; ++j) {
      q[j] = rng.Uniform(-2.4, 2.4);
      named[c.chain.joints[static_cast<std::size_t>(j)]] = q[j];
    }
    for (Eigen::Index j = 1; j <= n; ++j) {
      const std::string link =
          c.tree.joints.at(c.chain.joints[static_cast<std::size_t>(j - 1)]).child;
      const Matrix4d in_row =
          FrameOf(c.nominal, q, j).inverse() * before.Pose(GetParam().base_link, link, named);
      const Matrix4d in_calibrated_row =
          FrameOf(c.calibrated, q, j).inverse() * after.Pose(GetParam().base_link, link, named);
      EXPECT_LT((in_row - in_calibrated_row).cwiseAbs().maxCoeff(), kLinkTolerance) << link;
    }
    const Matrix4d X_AE = FrameOf(c.calibrated, q, n) * c.nominal.X_TQ.matrix();
    EXPECT_LT(
        (after.Pose(GetParam().base_link, GetParam().tip_link, named) - X_AE).cwiseAbs().maxCoeff(),
        kLinkTolerance);
  }
}

TEST_P(UrdfCorrectedTest, NothingElseMoves) {
  const UrdfCase c = UrdfCaseOf(GetParam());
  const std::string after = Corrected(c, {"a remark"});
  EXPECT_EQ(Rest(after), Rest(GetParam().text));
  EXPECT_NE(after, GetParam().text);
}

TEST_P(UrdfCorrectedTest, WithoutCorrectionsTheFileStaysByteForByte) {
  UrdfCase c = UrdfCaseOf(GetParam());
  c.calibrated = c.nominal;
  EXPECT_EQ(Corrected(c), GetParam().text);
}

TEST_P(UrdfCorrectedTest, CheckUrdfPasses) {
  if (std::system("command -v check_urdf > /dev/null") != 0) {
    GTEST_SKIP() << "check_urdf (package liburdfdom-tools) is not installed";
  }
  const TempFolder folder;
  WriteFile(folder / "out.urdf", Corrected(UrdfCaseOf(GetParam()), {"-- remark --"}));
  EXPECT_EQ(std::system(("check_urdf " + (folder / "out.urdf") + " > /dev/null 2>&1").c_str()), 0);
}

/// What is put in is found: rows of the corrected file, where it is read again, are the calibrated
/// ones up to what slides along an axis.
TEST_P(UrdfCorrectedTest, ReadAgainIsTheCalibratedRobot) {
  const UrdfCase c = UrdfCaseOf(GetParam());
  Diagnostics diagnostics;
  const auto tree = ParseUrdf("out.urdf", Corrected(c), &diagnostics);
  ASSERT_TRUE(tree) << diagnostics.ToString();
  const auto chain =
      FindUrdfChain(*tree, {GetParam().base_link, GetParam().tip_link, {}, {}}, &diagnostics);
  ASSERT_TRUE(chain) << diagnostics.ToString();
  const RobotModel again = RobotOfUrdf(*tree, *chain, &diagnostics);
  const auto n = static_cast<Eigen::Index>(c.chain.joints.size());
  const VectorXd q = VectorXd::LinSpaced(n, -1, 1.5), none = VectorXd::Zero(5 * n + 12);
  const Matrix4d X = independent::ForwardKinematics<double>(c.calibrated, q, none);
  EXPECT_LT((independent::ForwardKinematics<double>(again, q, none) - X).cwiseAbs().maxCoeff(),
            kLinkTolerance);
}

INSTANTIATE_TEST_SUITE_P(Robots,
                         UrdfCorrectedTest,
                         testing::ValuesIn(AllUrdfs()),
                         [](const testing::TestParamInfo<UrdfRobot>& robot) {
                           return robot.param.name;
                         });

TEST(UrdfCorrected, SaysWhereBaseAndMeasuredPointAre) {
  UrdfCase c = UrdfCaseOf(PublishedUrdfs().front());
  c.calibrated = c.nominal;
  c.calibrated.X_WB = Eigen::Translation3d(1, 2, 3) * c.nominal.X_WB;
  c.calibrated.X_TQ = c.nominal.X_TQ * Eigen::Translation3d(0, 0, 0.0125);
  const std::string text = Corrected(c, {"joint 2 -- compliant"});
  EXPECT_THAT(text, HasSubstr("base_link in the measurement frame: xyz 1000.0000 2000.0000"));
  EXPECT_THAT(text, HasSubstr("measured point in tool0: xyz 0.0000 0.0000 12.5000 mm"));
  EXPECT_THAT(text, HasSubstr("joint 2 - - compliant"));
}

TEST(UrdfCorrected, TurnsTheAxisOfAJointThatCountsTheOtherWay) {
  for (const UrdfRobot& robot : PublishedUrdfs()) {
    UrdfCase c = UrdfCaseOf(robot);
    for (JointRow& row : c.calibrated.joints) row.sign = -1;
    const UrdfWalk after(Corrected(c));
    const auto n = static_cast<Eigen::Index>(c.chain.joints.size());
    const VectorXd q = VectorXd::LinSpaced(n, -1, 1.5);
    UrdfWalk::Coordinates named;
    for (Eigen::Index j = 0; j < n; ++j) named[c.chain.joints[static_cast<std::size_t>(j)]] = q[j];
    const Matrix4d X = FrameOf(c.calibrated, q, n) * c.nominal.X_TQ.matrix();
    EXPECT_LT((after.Pose(robot.base_link, robot.tip_link, named) - X).cwiseAbs().maxCoeff(),
              kLinkTolerance)
        << robot.name;
  }
}

TEST(UrdfCorrected, RefusesRowsOfAnotherRobot) {
  const UrdfCase c = UrdfCaseOf(PublishedUrdfs()[0]);
  const UrdfCase other = UrdfCaseOf(PublishedUrdfs()[1]);
  Diagnostics diagnostics;
  EXPECT_FALSE(CorrectedUrdf(c.tree, c.chain, other.calibrated, {}, &diagnostics));
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("the rows are not those of the chain from"));
}

}  // namespace
}  // namespace dhcal
