// The rows of the diagnosis are those of the residual blocks: same derivatives, same residuals.
#include "problems/diagnosis/design_rows.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "problems/diagnosis/projection.h"
#include "residuals/registry.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"
#include "tests/support/same_rows.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

struct Kind {
  const char* name;
  MeasurementKind kind;
  NoiseKind noise;
};

class DesignRowsLaw : public testing::TestWithParam<Kind> {};

TEST_P(DesignRowsLaw, LeaveTheSameSquaresAsTheResidualBlocks) {
  const TrueRobot truth = MakeTrueRobot(Kr15(), 4);
  ProblemSpec spec = MakeSpec(truth.nominal, GetParam().kind, GetParam().noise);
  if (GetParam().kind.name == "distance") {
    spec.measurement.anchors = {{"a", Eigen::Vector3d(2, 0, 0)}, {"b", Eigen::Vector3d(0, 2, 1)}};
  }
  RecordingPlan plan;
  plan.poses = 60;
  const Recording recording = Record(truth, spec, plan);
  spec.parameters.effects.resize(1);
  spec.parameters.effects[0].effect = "joint_gain";
  spec.parameters.effects[0].joint = 3;
  const Calibration c(spec, recording);
  const Noise noise{20e-6, 50e-6};
  ExpectRowsOfTheResidualBlocks(c, noise);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds,
    DesignRowsLaw,
    testing::Values(Kind{"position", KindNamed("position"), NoiseKind::kIndependent},
                    Kind{"pose", KindNamed("pose"), NoiseKind::kIndependent},
                    Kind{"adjacent", KindNamed("adjacent_position"), NoiseKind::kIndependent},
                    Kind{"shared", KindNamed("adjacent_position"), NoiseKind::kSharedPose},
                    Kind{"distance", KindNamed("distance"), NoiseKind::kIndependent}),
    [](const auto& param) { return std::string(param.param.name); });

TEST(DesignRows, RoundingAtPlacesIsNoiseThatTheirRowsShare) {
  const TrueRobot truth = MakeTrueRobot(Kr15(), 5);
  for (const NoiseKind noise : {NoiseKind::kIndependent, NoiseKind::kSharedPose}) {
    const char* kind = noise == NoiseKind::kSharedPose ? "adjacent_position" : "position";
    const ProblemSpec spec = MakeSpec(truth.nominal, KindNamed(kind), noise);
    RecordingPlan plan;
    plan.poses = 40;
    Recording recording = Record(truth, spec, plan);
    const double quantum = 0.01 * kDegree;
    for (int row = 0; row < 40; ++row) recording.q(row, 2) = (row % 4) * 20.01 * kDegree;
    const Calibration c(spec, recording);
    const Eigen::MatrixXd deltas = Eigen::MatrixXd::Zero(c.chain.slots().size(), 40);
    RowWeights weights;
    weights.noise = {20e-6, 50e-6};
    const DesignRows plain(c, deltas, weights, c.readings.fitted);
    weights.read_out.quantum = Eigen::VectorXd::Zero(6);
    weights.read_out.level = Eigen::VectorXd::Unit(6, 2) * quantum;
    const DesignRows rounded(c, deltas, weights, c.readings.fitted);

    Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(plain.num_rows(), plain.num_rows());
    for (int place = 0; place < 4; ++place) {
      Eigen::VectorXd weight = Eigen::VectorXd::Zero(40);
      for (int row = place; row < 40; row += 4) weight[row] = quantum / std::sqrt(12.0);
      const Eigen::VectorXd column =
          plain.Column({{c.chain.slots().joint(2, JointSlot::kTheta), weight}});
      covariance += column * column.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
    const Eigen::MatrixXd A = eigen.operatorInverseSqrt() * plain.Geometry(c.parameters);
    EXPECT_LT((rounded.Geometry(c.parameters) - A).norm(), 1e-9 * A.norm()) << kind;
    const Eigen::VectorXd y = eigen.operatorInverseSqrt() * plain.y();
    EXPECT_LT((rounded.y() - y).norm(), 1e-9 * y.norm()) << kind;
    EXPECT_LT(y.norm(), 0.999 * plain.y().norm()) << "else nothing was to take out";
  }
}

TEST(OrthonormalBasis, MakesNoDirectionsOutOfRounding) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Random(30, 4);
  J.col(2).setConstant(1e-13);
  J.col(3) = J.col(0) + 2 * J.col(1);
  EXPECT_EQ(OrthonormalBasis(J).cols(), 2);
}

TEST(RmsAsRead, IsOfTheLengthsByEachRowsOwnSigma) {
  Draw draw = MakeDraw(Scenario(), 1);
  draw.recording.sigma.setConstant(draw.recording.num_rows(), 1e-3);
  draw.recording.sigma[1] = 3e-3;
  Calibration c(draw.spec, draw.recording);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(6);
  const double expected = std::sqrt((1e-6 + 9e-6) / 2);
  EXPECT_NEAR(RmsAsRead(c, {}, {0, 0, 0, 1, 1, 1}, ones), expected, 1e-15);
  draw.spec.measurement.kind = KindNamed("pose");
  Eigen::VectorXd pose = Eigen::VectorXd::Ones(12);
  pose.segment(3, 3).setConstant(100);
  EXPECT_NEAR(RmsAsRead(c, {}, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, pose), expected, 1e-15);
  EXPECT_TRUE(std::isnan(RmsAsRead(c, {}, {}, {})));
}

}  // namespace
}  // namespace dhcal
