// The simulated head, held to an independent one and to laws worked by hand.
#include "tools/proof/simulator/head.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/edge_head.h"
#include "tools/proof/simulator/arms.h"
#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/scenarios.h"
#include "tools/proof/simulator/truth.h"
#include "tools/proof/simulator/visibility.h"

namespace dhcal::concealed {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

struct Ride {
  Arm arm = KukaKr15();
  EdgeHead head;
  Motion motion;

  Ride() {
    Rng rng(4);
    motion = AlongEdges(arm, {3, 8, 2}, &head, &rng);
  }
  MatrixXd Numbers(const Cause* cause = nullptr) const {
    Physics physics(arm.num_joints());
    if (cause != nullptr) cause->apply(&physics, 1);
    return HeadNumbers(head, arm, physics, motion);
  }
};

TEST(EdgeHead, ReadsWhatTheIndependentHeadReads) {
  const Ride ride;
  HeadSpec spec;
  spec.camera.p_QS = ride.head.camera;
  for (std::size_t k = 0; k < 2; ++k) spec.lasers[k].p_QS = ride.head.lasers[k];
  const auto poses = TruePoses(ride.arm, Physics(ride.arm.num_joints()), ride.motion);
  const MatrixXd numbers = ride.Numbers();
  for (int row = 0; row < ride.motion.num_poses(); ++row) {
    const auto i = static_cast<std::size_t>(row);
    const auto placement = static_cast<std::size_t>(ride.motion.run[i]) - 1;
    Vector3d expected = independent::HeadNumbers<double>(
        spec, poses[i].matrix(), ride.head.placements[placement].matrix());
    expected[0] +=
        numbers(0, 0) - independent::HeadNumbers<double>(
                            spec, poses[0].matrix(), ride.head.placements[0].matrix())[0];
    EXPECT_LT((numbers.row(row).transpose() - expected).norm(), 1e-10) << row;
    EXPECT_NEAR(numbers(row, 1), 0.05, 0.06) << "the head is not over the edge in row " << row;
  }
}

TEST(EdgeHead, PlacementsAreRunsWithUnseenRowsAtTheirEnds) {
  const Ride ride;
  ASSERT_EQ(ride.motion.num_poses(), 24);
  for (int row = 0; row < 24; ++row) {
    EXPECT_EQ(ride.motion.run[static_cast<std::size_t>(row)], 1 + row / 8);
    EXPECT_EQ(ride.motion.test[static_cast<std::size_t>(row)], row % 8 >= 6);
  }
}

TEST(EdgeHead, FaultsActByTheirLaws) {
  const Ride ride;
  const MatrixXd sound = ride.Numbers();
  const Cause bow = EdgeIsBowed(1e-3), higher = RuledFaceHigher(1e-3), pixels = PixelsWrong(0.1);
  const Cause bent = LaserBends(2, 0.1, 0), slant = BeamSlants(1, {1e-3, 0});
  const MatrixXd bowed = ride.Numbers(&bow) - sound, raised = ride.Numbers(&higher) - sound;
  const MatrixXd pixel = ride.Numbers(&pixels) - sound, curved = ride.Numbers(&bent) - sound;
  const MatrixXd slanted = ride.Numbers(&slant) - sound;
  for (int row = 0; row < sound.rows(); ++row) {
    // Of a sight that leans by some 25 deg at most.
    EXPECT_LT(bowed(row, 1), 0) << "a face with raised ends stands nearer";
    EXPECT_LT(std::abs(raised(row, 0)), 1e-3 * std::tan(40 * kDegree));
    EXPECT_EQ(raised.row(row).tail<2>().norm(), 0);
    const double offset = std::remainder(sound(row, 0), ride.head.pitch);
    EXPECT_NEAR(pixel(row, 0), 0.1 * offset, 1e-12);
    EXPECT_NEAR(curved(row, 2), 0.1 * std::pow(sound(row, 2) - 0.07, 2), 1e-12);
    EXPECT_LT(std::abs(slanted(row, 1)), 1e-3 * sound(row, 1));
    EXPECT_EQ(slanted(row, 2), 0);
  }
}

TEST(EdgeHead, GeometryHidesAsMuchAsTheReadingsLose) {
  // 4 per turning axis with the head, less 1 along its parallel sights, and 4 of each placement.
  Rng rng(6);
  EdgeHead head;
  const Arm arm = KukaKr15();
  const Motion motion = AlongEdges(arm, {8, 14, 0}, &head, &rng);
  const MatrixXd differences = Differences(HeadSignatures(head, arm, arm, motion), motion);
  const Eigen::VectorXd s = differences.bdcSvd().singularValues();
  EXPECT_EQ((s.array() > 1e-7 * s[0]).count(), 24 - 1 + 4 * 8);
}

TEST(EdgeHead, EveryScenarioIsDetectableAndOnlyWhereItSaysSo) {
  for (const Scenario& scenario : HeadScenarios()) {
    const Trial trial = MakeTrial(scenario, 1);
    EXPECT_EQ(trial.causes.empty(), scenario.group == Group::kNull) << scenario.name;
    for (const Cause& cause : trial.causes) {
      EXPECT_GT(cause.visibility.power, 0.95) << scenario.name;
    }
  }
}

}  // namespace
}  // namespace dhcal::concealed
