// The simulator behind the concealed recordings, held to analytic answers and to an independent
// forward kinematics. It must be right by itself: nothing of it is shared with the product.

#include "tools/proof/simulator/truth.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/matchers.h"
#include "tools/proof/simulator/arm.h"
#include "tools/proof/simulator/arms.h"
#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/sensor.h"
#include "tools/proof/simulator/statics.h"

namespace dhcal::concealed {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kGravity = 9.80665;

/// A horizontal arm of one joint: turns about the base's y axis, a mass at the end of a rod.
Arm Pendulum(double length, double mass) {
  Arm arm;
  arm.links.resize(2);
  // The first joint never moves here; its row lays the second joint's axis along y.
  arm.links[0].alpha = -kPi / 2;
  arm.links[1].a = length;
  arm.links[1].mass = mass;
  arm.payload = 0;
  return arm;
}

Motion Poses(const Eigen::MatrixXd& q) {
  Motion motion;
  motion.q = q;
  motion.time = VectorXd::LinSpaced(q.rows(), 0, 40.0 * static_cast<double>(q.rows() - 1));
  motion.payload = VectorXd::Zero(q.rows());
  motion.run.assign(static_cast<std::size_t>(q.rows()), 1);
  motion.test.assign(static_cast<std::size_t>(q.rows()), false);
  return motion;
}

/// Of one joint, the first of a one-link arm.
Motion OneJoint(const std::vector<double>& angles) {
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(angles.size()), 2);
  for (std::size_t k = 0; k < angles.size(); ++k) q(static_cast<Eigen::Index>(k), 1) = angles[k];
  return Poses(q);
}

class EveryArm : public ::testing::TestWithParam<Arm (*)()> {};

TEST_P(EveryArm, ExponentialsGoWhereTheTextbooksMatricesGo) {
  Rng rng(5);
  const Arm arm = AsBuilt(GetParam()(), &rng);
  const Motion motion = RandomPoses(arm, arm.wide, 20, &rng);
  const Eigen::MatrixXd positions = TruePositions(arm, Physics(arm.num_joints()), motion);
  for (int row = 0; row < motion.num_poses(); ++row) {
    independent::Matrix4<double> X = arm.base.matrix();
    for (int j = 0; j < arm.num_joints(); ++j) {
      const DrawnLink& link = arm.links[static_cast<std::size_t>(j)];
      const double theta = link.theta + (link.slides ? 0 : motion.q(row, j));
      const double d = link.d + (link.slides ? motion.q(row, j) : 0);
      const auto tilt = independent::TurnAboutY<double>(link.beta);
      if (arm.convention == Convention::kStandard) {
        X = X * independent::StandardRow<double>(theta, d, link.a, link.alpha) * tilt;
      } else {
        X = X * independent::ModifiedRow<double>(0, 0, link.a, link.alpha) * tilt *
            independent::ModifiedRow<double>(theta, d, 0, 0);
      }
    }
    const Vector3d expected = (X * arm.tool.translation().homogeneous()).head<3>();
    EXPECT_THAT(positions.row(row).transpose(), MatrixNear(expected, 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Arms,
    EveryArm,
    ::testing::Values(&KukaKr15, &UniversalUr10, &SmallArm, &ModifiedSix, &SevenAxes, &Scara));

TEST(Statics, ACompliantPendulumHangsWhereSpringAndWeightBalance) {
  const double length = 0.8, mass = 20, compliance = 1e-4;
  const Arm arm = Pendulum(length, mass);
  Physics physics(2);
  physics.drives[1].compliance = compliance;
  const double q = -0.3;
  const Vector3d p = TruePositions(arm, physics, OneJoint({q})).row(0).transpose();
  // Turning about y by a positive angle lowers the rod; solve t = c m g L cos(q + t) by itself.
  double yielded = 0;
  for (int k = 0; k < 100; ++k) {
    yielded = compliance * mass * kGravity * length * std::cos(q + yielded);
  }
  EXPECT_GT(yielded, 0.01) << "far beyond first order";
  EXPECT_NEAR(p.x(), length * std::cos(q + yielded), 1e-12);
  EXPECT_NEAR(p.z(), -length * std::sin(q + yielded), 1e-12);
}

TEST(Statics, AClampedBeamBendsByTheTextbooksFormula) {
  // A weight at the tip: deflection F L^3 / (3 EI).
  const double length = 1.0, weight = 30, flexibility = 1e-6;
  Arm arm = Pendulum(length, 0);
  arm.payload = weight;
  Physics physics(2);
  physics.link_flexibility[1] = flexibility;
  Motion motion = OneJoint({0});
  motion.payload[0] = weight;
  const Vector3d p = TruePositions(arm, physics, motion).row(0).transpose();
  EXPECT_NEAR(p.z(), -flexibility * weight * kGravity * length * length * length / 3, 1e-7);
}

TEST(Statics, ABaseTiltsByItsOverturningMoment) {
  const double length = 0.8, mass = 20, compliance = 1e-5;
  Physics physics(2);
  physics.base_compliance = Eigen::Vector2d(0, compliance);
  const Vector3d p =
      TruePositions(Pendulum(length, mass), physics, OneJoint({0})).row(0).transpose();
  const double tilt = compliance * mass * kGravity * length;
  EXPECT_NEAR(p.z(), -length * std::sin(tilt), 1e-12);
}

TEST(Statics, AGearIsSofterBelowItsTorque) {
  const double compliance = 1e-5, soft = 50;
  Physics physics(2);
  YieldsSoftly(2, compliance, soft).apply(&physics, 1);
  const double length = 1, mass = 20;
  const Vector3d p =
      TruePositions(Pendulum(length, mass), physics, OneJoint({0})).row(0).transpose();
  const double torque = mass * kGravity * length;
  const double yielded = compliance * (1.3 * soft + (torque - soft));
  EXPECT_NEAR(-p.z(), yielded, 1e-3 * yielded);
}

TEST(Play, TheLinkFollowsOnlyOnceTheGapIsClosed) {
  Physics physics(2);
  Plays(2, 1e-3).apply(&physics, 1);
  // Forward: half a gap behind. Back by less than the gap: the link stays where it was.
  const Eigen::MatrixXd lost =
      LostMotion(Pendulum(1, 0), physics, OneJoint({0, 0.1, 0.0995, 0.05, 0.2}));
  const std::vector<double> expected = {0, -0.5e-3, 0, 0.5e-3, -0.5e-3};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(lost(static_cast<Eigen::Index>(k), 1), expected[k], 1e-12) << "pose " << k;
  }
}

TEST(Play, GravityHoldsALoadedGearOnOneFlank) {
  Physics physics(2);
  PlaysUnderLoad(2, 1e-3, 10).apply(&physics, 1);
  const Eigen::MatrixXd lost =
      LostMotion(Pendulum(1, 20), physics, OneJoint({0.3, -0.3, 0.1, kPi - 0.2}));
  EXPECT_NEAR(lost(1, 1), 0.5e-3, 1e-12);
  EXPECT_NEAR(lost(2, 1), 0.5e-3, 1e-12) << "from the other side: the same flank";
  EXPECT_NEAR(lost(3, 1), -0.5e-3, 1e-12) << "beyond the top the weight pulls the other way";
}

TEST(WindUp, BuildsUpWithTravelAndForgetsInANewRun) {
  Physics physics(2);
  WindsUp(2, 1e-4).apply(&physics, 1);
  Motion motion = OneJoint({0, 1e-3, 0.5, 0.6});
  motion.run = {1, 1, 1, 2};
  const Eigen::MatrixXd lost = LostMotion(Pendulum(1, 0), physics, motion);
  EXPECT_NEAR(lost(1, 1), -1e-4 * (1 - std::exp(-1.0)), 1e-12);
  EXPECT_NEAR(lost(2, 1), -1e-4, 1e-12);
  EXPECT_EQ(lost(3, 1), 0);
}

TEST(Heat, TheFirstBodyWarmsExponentiallyAndTheSecondBehindIt) {
  Arm arm = Pendulum(1, 0);
  arm.links[0].d = 1;
  Physics physics(2);
  FirstLinkGrows(1e-4, 2000).apply(&physics, 1);
  SecondLinkGrows(1e-4, 1000).apply(&physics, 1);
  Motion motion = OneJoint({0, 0, 0});
  motion.time = Vector3d(0, 2000, 1e6);
  const Eigen::MatrixXd p = TruePositions(arm, physics, motion);
  EXPECT_NEAR(p(1, 2) - p(0, 2), 1e-4 * (1 - std::exp(-1.0)), 1e-9) << "link 1 stands along z";
  EXPECT_NEAR(p(2, 0) - p(0, 0), 1e-4, 1e-9) << "link 2 lies along x";
  // Two lags in a row, by hand: 1 + (b e^(-t/b) - a e^(-t/a)) / (a - b), a = 2000 s, b = 1000 s.
  const double second = 1 + (1000 * std::exp(-2.0) - 2000 * std::exp(-1.0)) / (2000 - 1000);
  EXPECT_NEAR(p(1, 0) - p(0, 0), 1e-4 * second, 2e-7);
}

TEST(Timing, ALateReadingSeesWhereTheJointsWere) {
  Physics physics(2);
  Late(2e-3).apply(&physics, 1);
  Motion motion = OneJoint({0.5});
  motion.speed = Eigen::MatrixXd::Zero(1, 2);
  motion.speed(0, 1) = 0.25;
  const Arm arm = Pendulum(1, 0);
  const Eigen::MatrixXd late = TruePositions(arm, physics, motion);
  const Eigen::MatrixXd before = TruePositions(arm, Physics(2), OneJoint({0.5 - 0.5e-3}));
  EXPECT_THAT(late, MatrixNear(before, 1e-14));
}

TEST(SensorNoise, HasTheStatedDeviationAndCorrelation) {
  Rng rng(3);
  Sensor sensor;
  sensor.noise = 1e-3;
  sensor.heavy_tails = false;
  sensor.correlation = 0.5;
  const Eigen::MatrixXd readings = Read(sensor, Eigen::MatrixXd::Zero(40000, 3), &rng);
  const double variance = readings.squaredNorm() / static_cast<double>(readings.size());
  EXPECT_NEAR(std::sqrt(variance), sensor.noise, 0.02e-3);
  const Eigen::Index n = readings.rows() - 1;
  const double lagged =
      readings.topRows(n).cwiseProduct(readings.bottomRows(n)).sum() / static_cast<double>(3 * n);
  EXPECT_NEAR(lagged / variance, 0.5, 0.02);
}

TEST(SensorNoise, WrongGraduationsAreWholePitches) {
  Rng rng(4);
  Sensor sensor;
  sensor.wrong_share = 0.1;
  const Eigen::MatrixXd readings = Read(sensor, Eigen::MatrixXd::Zero(5000, 3), &rng);
  const auto wrong = (readings.array().abs() > 0.5e-3).count();
  EXPECT_NEAR(static_cast<double>(wrong), 500, 80);
  EXPECT_NEAR(readings.cwiseAbs().maxCoeff(), 1e-3, 1e-12);
}

}  // namespace
}  // namespace dhcal::concealed
