// Tiles of poses against DhChain, which dh_chain_test.cc holds against independent kinematics.
#include "core/kinematics/pose_tile.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/independent_kinematics.h"
#include "tests/support/matchers.h"
#include "tests/support/robots.h"
#include "tests/support/simd_levels.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kPoses = PoseTile::kPoses;

std::vector<int> AllSlots(const RobotModel& robot) {
  std::vector<int> slots(static_cast<std::size_t>(SlotLayout(robot.num_joints()).size()));
  std::iota(slots.begin(), slots.end(), 0);
  return slots;
}

MatrixXd RandomPoses(const RobotModel& robot, int count, Rng* rng) {
  MatrixXd q(robot.num_joints(), count);
  for (int k = 0; k < count; ++k) q.col(k) = RandomJoints(robot, rng);
  return q;
}

/// What poses add to slots: amounts of +-`size` for `slots`, zero rows for the others.
MatrixXd RandomAmounts(const RobotModel& robot,
                       const std::vector<int>& slots,
                       double size,
                       Rng* rng) {
  MatrixXd amounts = MatrixXd::Zero(SlotLayout(robot.num_joints()).size(), kPoses);
  for (const int slot : slots) {
    for (double& amount : amounts.row(slot)) amount = rng->Uniform(-size, size);
  }
  return amounts;
}

struct Circumstances {
  MatrixXd q;                     // joints x poses
  VectorXd delta;                 // of all slots
  std::vector<int> with_amounts;  // slots
  MatrixXd amounts;               // slots x kPoses
};

PoseTile Evaluated(const RobotModel& robot,
                   const std::vector<int>& slots,
                   bool with_rotation,
                   const Circumstances& at,
                   const simd::Kernels& kernels) {
  const PoseTileKernel kernel(robot, slots, with_rotation, kernels);
  std::vector<double> coordinates(static_cast<std::size_t>(kernel.num_coordinates()));
  kernel.FillCoordinates(at.q, coordinates.data());
  const PoseTileScope scope = kernel.Prepare({robot.X_WB, robot.X_TQ}, at.delta);
  const MatrixXd by_pose = at.amounts.transpose();
  PoseTileInput input{&scope, coordinates.data(), {}};
  for (const int slot : at.with_amounts) input.amounts.push_back({slot, by_pose.col(slot).data()});
  PoseTile tile = kernel.MakeTile();
  tile.J().setConstant(std::nan(""));
  kernel.Evaluate(input, &tile);
  return tile;
}

/// J of one pose: rows x y z of the tile's column, or of its turn.
MatrixXd Columns(const PoseTile& tile, int pose, int first_row) {
  MatrixXd J(3, tile.J().cols());
  for (int k = 0; k < 3; ++k) J.row(k) = tile.J().row(first_row + k * kPoses + pose);
  return J;
}

void ExpectAgreesWithChain(const RobotModel& robot,
                           const Circumstances& at,
                           const simd::Kernels& kernels) {
  const PoseTile tile = Evaluated(robot, AllSlots(robot), true, at, kernels);
  const DhChain chain(robot);
  PoseWithDerivatives expected;
  for (int pose = 0; pose < kPoses; ++pose) {
    SCOPED_TRACE("pose " + std::to_string(pose));
    const Eigen::Index of_q = std::min<Eigen::Index>(pose, at.q.cols() - 1);
    chain.PoseAndDerivatives(
        at.q.col(of_q), at.delta + at.amounts.col(pose), {robot.X_WB, robot.X_TQ}, &expected);
    const double reach = std::max(1.0, expected.p_WQ.norm());
    ASSERT_THAT(tile.p_WQ().row(pose).transpose(), MatrixNear(expected.p_WQ, 1e-13 * reach));
    ASSERT_THAT(tile.R_WQ(pose), MatrixNear(expected.R_WQ, 1e-13));
    ASSERT_THAT(Columns(tile, pose, 0), MatrixNear(expected.J_p, 1e-13 * reach));
    ASSERT_THAT(Columns(tile, pose, PoseTile::kRows), MatrixNear(expected.J_w, 1e-13));
  }
}

/// Robot and size of the perturbations.
class PoseTileLaws : public testing::TestWithParam<std::tuple<TestRobot, double>> {
 protected:
  const RobotModel& robot() const { return std::get<0>(GetParam()).model; }
  double size() const { return std::get<1>(GetParam()); }
};

TEST_P(PoseTileLaws, AgreesWithTheChainAtEveryLevel) {
  Rng rng(1);
  const Circumstances at{RandomPoses(robot(), kPoses, &rng),
                         RandomSlots(robot(), size(), &rng),
                         {},
                         RandomAmounts(robot(), {}, 0, &rng)};
  for (const simd::Kernels* kernels : simd::SupportedKernels()) {
    SCOPED_TRACE(kernels->name);
    ExpectAgreesWithChain(robot(), at, *kernels);
  }
}

TEST_P(PoseTileLaws, AgreesWithTheChainWhenPosesAddToEverySlot) {
  Rng rng(2);
  const Circumstances at{RandomPoses(robot(), kPoses, &rng),
                         RandomSlots(robot(), 0.3, &rng),
                         AllSlots(robot()),
                         RandomAmounts(robot(), AllSlots(robot()), size(), &rng)};
  for (const simd::Kernels* kernels : simd::SupportedKernels()) {
    SCOPED_TRACE(kernels->name);
    ExpectAgreesWithChain(robot(), at, *kernels);
  }
}

TEST_P(PoseTileLaws, AgreesWithTheChainWhenPosesAddToOneSlot) {
  Rng rng(3);
  for (const int slot : AllSlots(robot())) {
    SCOPED_TRACE(SlotLayout(robot().num_joints()).Name(slot));
    const Circumstances at{RandomPoses(robot(), kPoses, &rng),
                           VectorXd::Zero(SlotLayout(robot().num_joints()).size()),
                           {slot},
                           RandomAmounts(robot(), {slot}, size(), &rng)};
    ExpectAgreesWithChain(robot(), at, *simd::SupportedKernels().back());
  }
}

TEST_P(PoseTileLaws, HasTheSameBitsAtEveryLevel) {
  Rng rng(4);
  const std::vector<int> with_amounts = AllSlots(robot());
  const Circumstances at{RandomPoses(robot(), kPoses, &rng),
                         RandomSlots(robot(), size(), &rng),
                         with_amounts,
                         RandomAmounts(robot(), with_amounts, 1.5, &rng)};
  const PoseTile expected =
      Evaluated(robot(), AllSlots(robot()), true, at, *simd::SupportedKernels().front());
  for (const simd::Kernels* kernels : simd::SupportedKernels()) {
    SCOPED_TRACE(kernels->name);
    const PoseTile tile = Evaluated(robot(), AllSlots(robot()), true, at, *kernels);
    EXPECT_TRUE(SameBits(tile.p_WQ(), expected.p_WQ()));
    EXPECT_TRUE(SameBits(tile.R_WQ(), expected.R_WQ()));
    EXPECT_TRUE(SameBits(tile.J(), expected.J()));
  }
}

INSTANTIATE_TEST_SUITE_P(RobotsAndPerturbations,
                         PoseTileLaws,
                         testing::Combine(testing::ValuesIn(TestRobots()),
                                          testing::Values(0.0, 1e-8, 0.3, 2.0)),
                         [](const auto& test) {
                           const double size = std::get<1>(test.param);
                           return std::get<0>(test.param).model.name + (size == 0    ? "_nominal"
                                                                        : size < 0.1 ? "_tiny"
                                                                        : size < 1   ? "_random"
                                                                                     : "_large");
                         });

TEST(PoseTile, IsThatOfTheIndependentKinematics) {
  Rng rng(5);
  for (const RobotModel& robot : {Kr15(), Panda(), Scara(), ScaraModified()}) {
    SCOPED_TRACE(robot.name);
    const Circumstances at{RandomPoses(robot, 5, &rng),
                           RandomSlots(robot, 0.3, &rng),
                           {},
                           RandomAmounts(robot, {}, 0, &rng)};
    const PoseTile tile =
        Evaluated(robot, AllSlots(robot), true, at, *simd::SupportedKernels().back());
    for (int pose = 0; pose < 5; ++pose) {
      const Eigen::Matrix4d X =
          independent::ForwardKinematics<double>(robot, at.q.col(pose), at.delta);
      const independent::SlotDerivatives J =
          independent::ComplexStep(robot, at.q.col(pose), at.delta);
      const Vector3d p = X.topRightCorner<3, 1>();
      const double reach = std::max(1.0, p.norm());
      EXPECT_THAT(tile.p_WQ().row(pose).transpose(), MatrixNear(p, 1e-13 * reach));
      EXPECT_THAT(Columns(tile, pose, 0), MatrixNear(J.J_p, 1e-12 * reach));
      EXPECT_THAT(Columns(tile, pose, PoseTile::kRows), MatrixNear(J.J_w, 1e-12));
    }
  }
}

TEST(PoseTile, RepeatsTheLastPoseWhereThereAreFewer) {
  Rng rng(6);
  const RobotModel robot = Kr15();
  Circumstances at{RandomPoses(robot, 11, &rng),
                   RandomSlots(robot, 0.01, &rng),
                   {},
                   RandomAmounts(robot, {}, 0, &rng)};
  ExpectAgreesWithChain(robot, at, simd::ActiveKernels());
  const PoseTile tile = Evaluated(robot, AllSlots(robot), false, at, simd::ActiveKernels());
  for (int pose = 11; pose < kPoses; ++pose) {
    EXPECT_TRUE(SameBits(Columns(tile, pose, 0), Columns(tile, 10, 0)));
  }
}

TEST(PoseTile, ComputesTheSamePosesWithoutColumnsOrRotation) {
  Rng rng(7);
  for (const RobotModel& robot : {Ur10(), Panda(), Scara()}) {
    const Circumstances at{RandomPoses(robot, kPoses, &rng),
                           RandomSlots(robot, 0.01, &rng),
                           {1, 3},
                           RandomAmounts(robot, {1, 3}, 0.01, &rng)};
    const PoseTile all = Evaluated(robot, AllSlots(robot), true, at, simd::ActiveKernels());
    const PoseTile positions = Evaluated(robot, {}, false, at, simd::ActiveKernels());
    EXPECT_EQ(positions.J().cols(), 0);
    EXPECT_THAT(positions.p_WQ(), MatrixNear(all.p_WQ(), 1e-15));
    const PoseTile columns = Evaluated(robot, AllSlots(robot), false, at, simd::ActiveKernels());
    EXPECT_TRUE(SameBits(columns.J(), all.J().topRows(PoseTile::kRows)));
  }
}

TEST(PoseTile, LeavesColumnsWithoutASlotAlone) {
  const RobotModel robot = Kr15();
  const SlotLayout slots(robot.num_joints());
  const PoseTileKernel kernel(robot, {-1, slots.joint(1, JointSlot::kD), -1, slots.tool(4)}, true);
  PoseTile tile = kernel.MakeTile();
  EXPECT_TRUE(SameBits(tile.J(), MatrixXd::Zero(2 * PoseTile::kRows, 4)));
  tile.J().col(2).setConstant(7);
  std::vector<double> coordinates(static_cast<std::size_t>(kernel.num_coordinates()));
  kernel.FillCoordinates(VectorXd::Constant(6, 0.3), coordinates.data());
  const PoseTileScope scope = kernel.Prepare({}, VectorXd::Zero(slots.size()));
  kernel.Evaluate({&scope, coordinates.data(), {}}, &tile);
  EXPECT_TRUE((tile.J().col(0).array() == 0).all());
  EXPECT_TRUE((tile.J().col(2).array() == 7).all());
  PoseWithDerivatives expected;
  DhChain(robot).PoseAndDerivatives(
      VectorXd::Constant(6, 0.3), VectorXd::Zero(slots.size()), {}, &expected);
  const MatrixXd J = Columns(tile, 20, 0);
  EXPECT_THAT(J.col(1), MatrixNear(expected.J_p.col(slots.joint(1, JointSlot::kD)), 1e-13));
  EXPECT_THAT(J.col(3), MatrixNear(expected.J_p.col(slots.tool(4)), 1e-13));
}

/// One joint between plain ends: R_WQ holds the cosine and the sine of the angle added to theta.
class VectorSine : public testing::TestWithParam<const simd::Kernels*> {
 protected:
  /// Largest errors of sine and cosine, in units of the last place of the greater of the two.
  static double LargestError(const VectorXd& angles) {
    RobotModel robot;
    robot.joints.resize(1);
    double largest = 0;
    for (Eigen::Index first = 0; first < angles.size(); first += kPoses) {
      MatrixXd amounts = MatrixXd::Zero(SlotLayout(1).size(), kPoses);
      const Eigen::Index count = std::min<Eigen::Index>(kPoses, angles.size() - first);
      amounts.row(0).head(count) = angles.segment(first, count).transpose();
      const Circumstances at{
          MatrixXd::Zero(1, 1), VectorXd::Zero(SlotLayout(1).size()), {0}, amounts};
      const PoseTile tile = Evaluated(robot, {}, true, at, *GetParam());
      for (int pose = 0; pose < count; ++pose) {
        const long double angle = amounts(0, pose);
        for (const auto& [value, exact] : {std::pair(tile.R_WQ(pose)(0, 0), std::cos(angle)),
                                           std::pair(tile.R_WQ(pose)(1, 0), std::sin(angle))}) {
          const double ulp = std::nextafter(std::abs(static_cast<double>(exact)), 2.0) -
                             std::abs(static_cast<double>(exact));
          largest = std::max(largest, std::abs(static_cast<double>(value - exact)) / ulp);
        }
      }
    }
    return largest;
  }
};

TEST_P(VectorSine, IsExactToTheLastPlace) {
  EXPECT_LT(LargestError(VectorXd::LinSpaced(20001, -3.15, 3.15)), 1.0);
  EXPECT_LT(LargestError(VectorXd::LinSpaced(20001, -1e-3, 1e-3)), 1.0);
}

TEST_P(VectorSine, IsAsGoodFarOut) {
  // Reduced up to 1e4 rad; farther by libm. Some lanes of a vector are beyond, others are not.
  EXPECT_LT(LargestError(VectorXd::LinSpaced(20001, -2e4, 2e4)), 1.0);
  EXPECT_LT(LargestError(VectorXd::LinSpaced(101, -1e15, 1e15)), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Levels, VectorSine, EveryLevel(), LevelName);

TEST(PoseTileDeathTest, ASlotHasOneColumnAndOneAmount) {
  const RobotModel robot = Kr15();
  EXPECT_DEATH(PoseTileKernel(robot, {3, -1, 3}, false), "slot alpha1 has two columns");
  const PoseTileKernel kernel(robot, {3}, false);
  PoseTile tile = kernel.MakeTile();
  const PoseTileScope scope = kernel.Prepare({}, VectorXd::Zero(42));
  const std::vector<double> amount(kPoses);
  EXPECT_DEATH(kernel.Evaluate({&scope, nullptr, {{3, amount.data()}, {3, amount.data()}}}, &tile),
               "slot alpha1 has two amounts");
}

}  // namespace
}  // namespace dhcal
