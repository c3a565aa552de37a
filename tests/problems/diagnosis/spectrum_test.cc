// The scan of orders finds the line that is in the rows, and counts what it removes as a column of
// the model would.
#include "problems/diagnosis/spectrum.h"

#include <cmath>
#include <string>

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

}  // namespace
}  // namespace dhcal
