// Rows of both conventions are one robot: everything that hangs on it stays where it is. Rows for
// axes from URDFs: tests/problems/formats/urdf.
#include "core/kinematics/dh_rows.h"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/kinematics/dh_chain.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::VectorXd;

Matrix4d Forward(const RobotModel& robot, const VectorXd& q) {
  return independent::ForwardKinematics<double>(robot, q, VectorXd::Zero(5 * q.size() + 12));
}

DhConvention Other(const RobotModel& robot) {
  return robot.convention == DhConvention::kStandard ? DhConvention::kModified
                                                     : DhConvention::kStandard;
}

TEST(DhRows, OfTheOtherConventionMoveTheToolAlikeAndKeepEveryNumber) {
  Rng rng(1);
  for (const TestRobot& robot : TestRobots()) {
    const RobotModel other = InConvention(robot.model, Other(robot.model));
    for (int k = 0; k < 5; ++k) {
      const VectorXd q = RandomJoints(robot.model, &rng);
      EXPECT_LT((Forward(robot.model, q) - Forward(other, q)).cwiseAbs().maxCoeff(), 1e-13);
    }
    for (std::size_t j = 0; j < other.joints.size(); ++j) {
      EXPECT_EQ(other.joints[j].theta, robot.model.joints[j].theta);
      EXPECT_EQ(other.joints[j].d, robot.model.joints[j].d);
      EXPECT_EQ(other.joints[j].sign, robot.model.joints[j].sign);
    }
  }
}

TEST(DhRows, OfTheOtherConventionCarryMassesGravityAndPayloadAlong) {
  Rng rng(2);
  for (const TestRobot& robot : TestRobots()) {
    RobotModel one = robot.model;
    one.payload = {2, Vector3d(0.1, -0.2, 0.3)};
    one.links.assign(one.joints.size(), {5, Vector3d(0.3, 0.2, -0.1)});
    const RobotModel other = InConvention(one, Other(one));
    const VectorXd q = RandomJoints(one, &rng);
    const auto X_BL = DhChain(one).LinkFrames(q), X_AL = DhChain(other).LinkFrames(q);
    for (std::size_t j = 0; j < one.links.size(); ++j) {
      const Vector3d place = one.X_WB * X_BL[j + 1] * one.links[j].p_LC;
      EXPECT_LT((other.X_WB * X_AL[j + 1] * other.links[j].p_LC - place).norm(), 1e-13);
    }
    EXPECT_LT(
        (one.X_WB * X_BL.back() * one.payload.p_LC - other.X_WB * X_AL.back() * other.payload.p_LC)
            .norm(),
        1e-13);
    EXPECT_LT((one.X_WB.linear() * one.gravity_B - other.X_WB.linear() * other.gravity_B).norm(),
              1e-13);
  }
}

TEST(DhRows, OfAxesWithoutFarNormalsAreLeftAlone) {
  for (const TestRobot& robot : TestRobots()) {
    const RobotModel same = WithNearNormals(robot.model);
    for (std::size_t j = 0; j < same.joints.size(); ++j) {
      EXPECT_EQ(same.joints[j].d, robot.model.joints[j].d);
    }
  }
}

}  // namespace
}  // namespace dhcal
