// The scan of orders finds the line that is in the rows, and counts what it removes as a column of
// the model would.
#include "problems/diagnosis/spectrum.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "problems/diagnosis/projection.h"
#include "residuals/registry.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

constexpr int kJoint = 2, kRounded = 4, kPoses = 200;
constexpr double kOrder = 101.3;

struct Kind {
  const char* name;
  NoiseKind noise;
  bool rounded;  // another joint stops at five places, known to 0.01 deg
};

class ScanOrdersLaw : public testing::TestWithParam<Kind> {};

TEST_P(ScanOrdersLaw, RemovesWhatTheColumnsOfTheLineRemove) {
  const TrueRobot truth = MakeTrueRobot(Kr15(), 6);
  const ProblemSpec spec = MakeSpec(truth.nominal, KindNamed(GetParam().name), GetParam().noise);
  RecordingPlan plan;
  plan.poses = kPoses;
  Recording recording = Record(truth, spec, plan);
  RowWeights weights;
  weights.noise = {20e-6, 50e-6};
  if (GetParam().rounded) {
    for (int row = 0; row < kPoses; ++row) {
      recording.q(row, kRounded) = (row % 5) * 20.01 * kDegree;
    }
    weights.read_out.quantum = Eigen::VectorXd::Zero(6);
    weights.read_out.level = Eigen::VectorXd::Unit(6, kRounded) * 0.01 * kDegree;
  }
  const Calibration c(spec, recording);
  const Eigen::MatrixXd deltas = Eigen::MatrixXd::Zero(c.chain.slots().size(), kPoses);
  const DesignRows rows(c, deltas, weights, c.readings.fitted);
  const Eigen::MatrixXd basis = OrthonormalBasis(rows.Geometry(c.parameters));

  const int slot = c.chain.slots().joint(kJoint, JointSlot::kTheta);
  const auto line = [&](double order, double phase) {
    const Eigen::VectorXd angle = order * recording.q.col(kJoint);
    return rows.Column({{slot, (angle.array() + phase).sin().matrix()}});
  };
  const Eigen::VectorXd y = ProjectOff(basis, 40e-6 * line(kOrder, 0.7));
  const ScannedRows scanned{basis, y, static_cast<double>(rows.num_rows()), true};
  for (const SpectralPeak& peak : ScanOrders(c.Context(), rows, scanned)) {
    if (peak.joint != kJoint) {
      EXPECT_LT(peak.Q, 0.5 * y.squaredNorm());
      continue;
    }
    EXPECT_NEAR(peak.order, kOrder, 0.2);
    Eigen::MatrixXd columns(rows.num_rows(), 2);
    columns << line(peak.order, 0), line(peak.order, kPi / 2);
    const Eigen::MatrixXd U = OrthonormalBasis(ProjectOff(basis, columns));
    EXPECT_NEAR(peak.Q, (U.transpose() * y).squaredNorm(), 0.03 * y.squaredNorm());
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         ScanOrdersLaw,
                         testing::Values(Kind{"position", NoiseKind::kIndependent, false},
                                         Kind{"position", NoiseKind::kIndependent, true},
                                         Kind{"adjacent_position", NoiseKind::kIndependent, true}),
                         [](const auto& param) {
                           return std::string(param.param.name) +
                                  (param.param.rounded ? "_rounded" : "");
                         });

/// Highest orders of a line of an order in a joint that stops at every 20 degrees.
std::vector<double> OrdersOnAGrid(double order, bool with_rivals) {
  const TrueRobot truth = MakeTrueRobot(Kr15(), 7);
  const ProblemSpec spec = MakeSpec(truth.nominal, KindNamed("position"), NoiseKind::kIndependent);
  RecordingPlan plan;
  plan.poses = kPoses;
  Recording recording = Record(truth, spec, plan);
  for (int row = 0; row < kPoses; ++row) recording.q(row, kJoint) = (row * 7 % 9) * 20 * kDegree;
  RowWeights weights;
  weights.noise = {20e-6, 50e-6};
  const Calibration c(spec, recording);
  const Eigen::MatrixXd deltas = Eigen::MatrixXd::Zero(c.chain.slots().size(), kPoses);
  const DesignRows rows(c, deltas, weights, c.readings.fitted);
  const Eigen::MatrixXd basis = OrthonormalBasis(rows.Geometry(c.parameters));
  const Eigen::VectorXd angle = order * recording.q.col(kJoint);
  const Eigen::VectorXd line = rows.Column(
      {{c.chain.slots().joint(kJoint, JointSlot::kTheta), angle.array().cos().matrix()}});
  ScannedRows scanned{basis, ProjectOff(basis, 40e-6 * line), 600, true};
  scanned.with_rivals = with_rivals;
  std::vector<double> orders;
  for (const SpectralPeak& peak : ScanOrders(c.Context(), rows, scanned)) {
    if (peak.joint == kJoint) orders.push_back(peak.order);
  }
  return orders;
}

TEST(ScanOrders, AnOrderOfWhichPlacesShowOnePhaseOnlyIsNone) {
  // cos(9 q) is 1 and -1 in turn, and sin(9 q) is 0.
  const std::vector<double> orders = OrdersOnAGrid(9, true);
  ASSERT_FALSE(orders.empty());
  for (const double order : orders) EXPECT_LT(std::abs(std::remainder(order, 18)), 8.99);
}

TEST(ScanOrders, OrdersThatEvenStepsCannotTellApartAreRivals) {
  const std::vector<double> orders = OrdersOnAGrid(13, true);
  EXPECT_EQ(orders.size(), 4);
  for (const double order : orders) {
    EXPECT_NEAR(std::abs(std::remainder(order, 18)), 5, 0.02) << order;
  }
  EXPECT_EQ(OrdersOnAGrid(13, false).size(), 1);
}

TEST(StopsAtFewPlaces, IsAGridAndNoRandomSequence) {
  Eigen::VectorXd grid(60), spread(60);
  for (int k = 0; k < 60; ++k) {
    grid[k] = 0.3 * (k % 6);
    spread[k] = std::sin(1.7 * k);
  }
  EXPECT_TRUE(StopsAtFewPlaces(grid));
  EXPECT_FALSE(StopsAtFewPlaces(spread));
}

}  // namespace
}  // namespace dhcal
