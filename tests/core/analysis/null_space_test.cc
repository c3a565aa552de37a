#include "core/analysis/null_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/kinematics/slots.h"
#include "residuals/registry.h"

namespace dhcal {
namespace {

using ::testing::HasSubstr;

RobotModel ThreeJoints(double alpha1, double alpha2) {
  RobotModel robot;
  robot.joints.resize(3);
  robot.joints[0].alpha = alpha1;
  robot.joints[1].alpha = alpha2;
  return robot;
}

Parameter Named(const RobotModel& robot, int slot, ParameterGroup group) {
  const SlotLayout slots(robot.num_joints());
  Parameter parameter;
  parameter.name = slots.Name(slot);
  parameter.slot = slot;
  parameter.group = group;
  parameter.unit = slots.is_angle(slot) ? Unit::kRadian : Unit::kMetre;
  return parameter;
}

/// An SVD whose dropped directions are the columns of `dropped`.
TruncatedSvd WithDropped(const Eigen::MatrixXd& dropped) {
  TruncatedSvd svd;
  svd.V = dropped;
  svd.s = Eigen::VectorXd::Zero(dropped.cols());
  svd.scale = Eigen::VectorXd::Ones(dropped.rows());
  return svd;
}

TEST(AxesParallel, OnlyWithoutTwistBetweenThem) {
  EXPECT_TRUE(AxesParallel(ThreeJoints(0, 90 * kDegree), 0, 1));
  EXPECT_FALSE(AxesParallel(ThreeJoints(0, 90 * kDegree), 0, 2));
  EXPECT_TRUE(AxesParallel(ThreeJoints(180 * kDegree, 0), 0, 2));
  RobotModel modified = ThreeJoints(90 * kDegree, 0);
  modified.convention = DhConvention::kModified;
  EXPECT_TRUE(AxesParallel(modified, 0, 1));
}

TEST(SparseBasis, SeparatesMixedDirections) {
  Eigen::MatrixXd mixed(4, 2);
  mixed << 1, 1, 0, 0, 1, -1, -1, 1;
  const Eigen::MatrixXd basis = SparseBasis(mixed);
  // e1, and e3 - e4, in some order: each row has at most two entries.
  for (int row = 0; row < 2; ++row) {
    EXPECT_LE((basis.row(row).array().abs() > 1e-12).count(), 2);
  }
}

class Explained : public ::testing::Test {
 protected:
  std::string Of(const Eigen::MatrixXd& dropped, const MeasurementKind& kind) const {
    return ExplainNullSpace(WithDropped(dropped), parameters_, robot_, kind)[0].explanation;
  }

  RobotModel robot_ = ThreeJoints(0, 0);
  SlotLayout slots_{3};
  std::vector<Parameter> parameters_;
};

TEST_F(Explained, OffsetsAlongParallelAxesAreOneSum) {
  for (int joint = 0; joint < 3; ++joint) {
    parameters_.push_back(Named(robot_, slots_.joint(joint, JointSlot::kD), ParameterGroup::kD));
  }
  Eigen::MatrixXd dropped(3, 2);
  dropped << 1, 1, -1, 1, 0, -2;
  EXPECT_EQ(Of(dropped, KindNamed("position")),
            "only d1 + d2 + d3 is determined: axes 1, 2 and 3 are parallel");
}

TEST_F(Explained, OppositeAxesGiveADifference) {
  robot_ = ThreeJoints(180 * kDegree, 90 * kDegree);
  parameters_ = {Named(robot_, slots_.joint(0, JointSlot::kD), ParameterGroup::kD),
                 Named(robot_, slots_.joint(1, JointSlot::kD), ParameterGroup::kD)};
  EXPECT_EQ(Of(Eigen::Vector2d(1, 1), KindNamed("position")),
            "only d1 - d2 is determined: axes 1 and 2 are parallel");
}

TEST_F(Explained, LastAxisThroughTheMeasuredPoint) {
  parameters_ = {Named(robot_, slots_.joint(2, JointSlot::kTheta), ParameterGroup::kTheta)};
  EXPECT_THAT(Of(Eigen::VectorXd::Ones(1), KindNamed("position")),
              HasSubstr("theta3 turns about an axis through the measured point"));
}

TEST_F(Explained, CombinationOfLengthAndAngleCarriesItsLever) {
  parameters_ = {Named(robot_, slots_.joint(1, JointSlot::kTheta), ParameterGroup::kTheta),
                 Named(robot_, slots_.joint(1, JointSlot::kA), ParameterGroup::kA)};
  EXPECT_EQ(Of(Eigen::Vector2d(1, -0.34), KindNamed("position")),
            "only theta2 + 2.94 rad/m a2 is determined");
}

TEST_F(Explained, BaseAndFirstRowNameTheirReason) {
  parameters_ = {Named(robot_, slots_.joint(0, JointSlot::kD), ParameterGroup::kD),
                 Named(robot_, slots_.base(2), ParameterGroup::kBase)};
  EXPECT_EQ(Of(Eigen::Vector2d(1, -1), KindNamed("position")),
            "only d1 + base_z is determined: the base frame and the first DH row act alike");
}

TEST_F(Explained, WhatLiftsAllReadingsIsHiddenFromDifferences) {
  parameters_ = {Named(robot_, slots_.joint(0, JointSlot::kD), ParameterGroup::kD)};
  EXPECT_THAT(Of(Eigen::VectorXd::Ones(1), KindNamed("adjacent_position")),
              HasSubstr("shifts all measured points alike"));
}

TEST_F(Explained, WhatAPriorHidesIsNotBlamedOnGeometry) {
  robot_.joints[0].a = 0.5;
  robot_.joints[1].a = 0.4;
  robot_.X_TQ.translation() = Eigen::Vector3d(0, 0, 0.1);
  parameters_ = {Named(robot_, slots_.joint(0, JointSlot::kTheta), ParameterGroup::kTheta)};
  parameters_[0].prior_sigma = 1e-9;
  EXPECT_EQ(Of(Eigen::VectorXd::Ones(1), KindNamed("position")),
            "the readings say less about theta1 than its prior does");
  parameters_[0].prior_sigma.reset();
  EXPECT_EQ(Of(Eigen::VectorXd::Ones(1), KindNamed("position")),
            "the readings say less about theta1 than its tolerance does");
}

TEST_F(Explained, ALengthAlwaysMovesTheMeasuredPoint) {
  parameters_ = {Named(robot_, slots_.joint(1, JointSlot::kA), ParameterGroup::kA)};
  EXPECT_EQ(Of(Eigen::VectorXd::Ones(1), KindNamed("position")),
            "the readings say less about a2 than its tolerance does");
  EXPECT_THAT(Of(Eigen::VectorXd::Ones(1), KindNamed("adjacent_position")),
              HasSubstr("less about a2"))
      << "it turns with joint 1: differences show it";
}

TEST_F(Explained, AMeasuredOrientationShowsEveryTurn) {
  parameters_ = {Named(robot_, slots_.joint(2, JointSlot::kTheta), ParameterGroup::kTheta)};
  EXPECT_EQ(Of(Eigen::VectorXd::Ones(1), KindNamed("pose")),
            "the readings say less about theta3 than its tolerance does");
}

TEST_F(Explained, AnAxisBesideOneOfTheTargetsIsNotThroughTheMeasuredPoint) {
  robot_.joints[0].a = 0.5;
  robot_.targets.resize(2);
  parameters_ = {Named(robot_, slots_.joint(2, JointSlot::kTheta), ParameterGroup::kTheta)};
  EXPECT_THAT(Of(Eigen::VectorXd::Ones(1), KindNamed("position")),
              HasSubstr("through the measured point"));
  robot_.targets[1].X_TQ.translation() = Eigen::Vector3d(0.1, 0, 0);
  EXPECT_THAT(Of(Eigen::VectorXd::Ones(1), KindNamed("position")),
              HasSubstr("the readings say less about theta3"));
}

}  // namespace
}  // namespace dhcal
