// The chain against an independent forward kinematics, for all test robots in their special poses
// and random ones, with slots unperturbed, perturbed by 1e-8 and by up to 0.3.
#include "core/kinematics/dh_chain.h"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

#include <Eigen/SVD>
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "tests/support/independent_kinematics.h"
#include "tests/support/matchers.h"
#include "tests/support/ridders.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Jet = ceres::Jet<double, 1>;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// The product's pose, its outputs not-a-number beforehand.
PoseWithDerivatives Evaluate(const RobotModel& robot, const VectorXd& q, const VectorXd& delta) {
  const DhChain chain(robot);
  PoseWithDerivatives pose;
  pose.p_WQ.setConstant(kNotANumber);
  pose.R_WQ.setConstant(kNotANumber);
  pose.J_p.setConstant(3, delta.size(), kNotANumber);
  pose.J_w.setConstant(3, delta.size(), kNotANumber);
  chain.PoseAndDerivatives(q, delta, {robot.X_WB, robot.X_TQ}, &pose);
  return pose;
}

/// Lengths are compared relative to the robot's, angles absolutely.
double Reach(const Vector3d& p_WQ) { return std::max(1.0, p_WQ.norm()); }

/// Robot and size of the slots' perturbation.
class DhChainLaws : public testing::TestWithParam<std::tuple<TestRobot, double>> {
 protected:
  const RobotModel& robot() const { return std::get<0>(GetParam()).model; }

  /// Calls `check(q, delta)` at the special poses and ten random ones.
  template <typename Check>
  void AtAllPoses(const Check& check) const {
    const double size = std::get<1>(GetParam());
    Rng rng(20);
    for (const NamedPose& pose : std::get<0>(GetParam()).poses) {
      SCOPED_TRACE("pose " + pose.name);
      check(pose.q, RandomSlots(robot(), size, &rng));
    }
    for (int i = 0; i < 10; ++i) {
      SCOPED_TRACE("random pose " + std::to_string(i));
      const VectorXd q = RandomJoints(robot(), &rng);
      check(q, RandomSlots(robot(), size, &rng));
    }
  }
};

TEST_P(DhChainLaws, PoseIsThatOfTheIndependentKinematics) {
  AtAllPoses([&](const VectorXd& q, const VectorXd& delta) {
    const Eigen::Matrix4d X = independent::ForwardKinematics<double>(robot(), q, delta);
    const Vector3d p = X.topRightCorner<3, 1>();
    const Matrix3d R = X.topLeftCorner<3, 3>();
    const Eigen::Isometry3d X_WQ =
        DhChain(robot()).Pose<double>(q, delta, {robot().X_WB, robot().X_TQ});
    EXPECT_THAT(X_WQ.translation(), MatrixNear(p, 1e-13 * Reach(p)));
    EXPECT_THAT(X_WQ.linear(), MatrixNear(R, 1e-13));
    const PoseWithDerivatives pose = Evaluate(robot(), q, delta);
    EXPECT_THAT(pose.p_WQ, MatrixNear(p, 1e-13 * Reach(p)));
    EXPECT_THAT(pose.R_WQ, MatrixNear(R, 1e-13));
  });
}

TEST_P(DhChainLaws, DerivativesAreTheComplexStepsOfTheIndependentKinematics) {
  AtAllPoses([&](const VectorXd& q, const VectorXd& delta) {
    const PoseWithDerivatives pose = Evaluate(robot(), q, delta);
    const independent::SlotDerivatives expected = independent::ComplexStep(robot(), q, delta);
    EXPECT_THAT(pose.J_p, MatrixNear(expected.J_p, 1e-12 * Reach(pose.p_WQ)));
    EXPECT_THAT(pose.J_w, MatrixNear(expected.J_w, 1e-12));
  });
}

TEST_P(DhChainLaws, DerivativesAreThoseOfJetsThroughThePose) {
  const DhChain chain(robot());
  AtAllPoses([&](const VectorXd& q, const VectorXd& delta) {
    const PoseWithDerivatives pose = Evaluate(robot(), q, delta);
    MatrixXd J_p(3, delta.size()), J_w(3, delta.size());
    for (Eigen::Index slot = 0; slot < delta.size(); ++slot) {
      Eigen::Matrix<Jet, Eigen::Dynamic, 1> moved = delta.cast<Jet>();
      moved[slot].v[0] = 1;
      const auto X = chain.Pose<Jet>(q, moved, {robot().X_WB, robot().X_TQ});
      const auto derivative = [](const Jet& x) { return x.v[0]; };
      J_p.col(slot) = X.translation().unaryExpr(derivative);
      const Matrix3d w = X.linear().unaryExpr(derivative) * pose.R_WQ.transpose();
      J_w.col(slot) << w(2, 1), w(0, 2), w(1, 0);
    }
    EXPECT_THAT(pose.J_p, MatrixNear(J_p, 1e-12 * Reach(pose.p_WQ)));
    EXPECT_THAT(pose.J_w, MatrixNear(J_w, 1e-12));
  });
}

TEST_P(DhChainLaws, DerivativesAreRiddersDifferencesOfThePose) {
  const DhChain chain(robot());
  AtAllPoses([&](const VectorXd& q, const VectorXd& delta) {
    const PoseWithDerivatives pose = Evaluate(robot(), q, delta);
    // Position, and Log(R R_here'), whose derivative at zero is the turn.
    const auto move = [&](const VectorXd& slots) {
      const Eigen::Isometry3d X = chain.Pose<double>(q, slots, {robot().X_WB, robot().X_TQ});
      VectorXd result(6);
      result << X.translation(), LogSO3(X.linear() * pose.R_WQ.transpose());
      return result;
    };
    const MatrixXd J = RiddersJacobian(move, delta);
    EXPECT_THAT(pose.J_p, MatrixNear(J.topRows(3), 1e-9 * Reach(pose.p_WQ)));
    EXPECT_THAT(pose.J_w, MatrixNear(J.bottomRows(3), 1e-9));
  });
}

TEST_P(DhChainLaws, FlangePoseIsThePoseBetweenPlainEnds) {
  const RobotModel plain = WithPlainEnds(robot());
  AtAllPoses([&](const VectorXd& q, VectorXd delta) {
    const Eigen::Isometry3d X_BT = DhChain(robot()).FlangePose(q, delta);
    delta.tail<12>().setZero();
    const Eigen::Matrix4d X = independent::ForwardKinematics<double>(plain, q, delta);
    EXPECT_THAT(X_BT.matrix(), MatrixNear(X, 1e-13 * Reach(X.topRightCorner<3, 1>())));
  });
}

INSTANTIATE_TEST_SUITE_P(RobotsAndPerturbations,
                         DhChainLaws,
                         testing::Combine(testing::ValuesIn(TestRobots()),
                                          testing::Values(0.0, 1e-8, 0.3)),
                         [](const auto& test) {
                           const double size = std::get<1>(test.param);
                           return std::get<0>(test.param).model.name + (size == 0    ? "_nominal"
                                                                        : size < 0.1 ? "_tiny"
                                                                                     : "_random");
                         });

class TestRobotPoses : public testing::TestWithParam<TestRobot> {};

TEST_P(TestRobotPoses, AreSingularWhereTheySay) {
  const RobotModel& robot = GetParam().model;
  const SlotLayout slots(robot.num_joints());
  for (const NamedPose& named : GetParam().poses) {
    const PoseWithDerivatives pose = Evaluate(robot, named.q, VectorXd::Zero(slots.size()));
    MatrixXd J(6, robot.num_joints());
    for (int i = 0; i < robot.num_joints(); ++i) {
      const bool slides = robot.joints[static_cast<std::size_t>(i)].type == JointType::kPrismatic;
      const int slot = slots.joint(i, slides ? JointSlot::kD : JointSlot::kTheta);
      J.col(i) << pose.J_p.col(slot), pose.J_w.col(slot);
    }
    const double smallest = Eigen::JacobiSVD<MatrixXd>(J).singularValues().tail<1>()[0];
    // Singular poses are so up to rounding; the others are far from it.
    if (named.singular) {
      EXPECT_LT(smallest, 1e-14) << named.name;
    } else {
      EXPECT_GT(smallest, 1e-3) << named.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots,
                         TestRobotPoses,
                         testing::ValuesIn(TestRobots()),
                         [](const auto& test) { return test.param.model.name; });

}  // namespace
}  // namespace dhcal
