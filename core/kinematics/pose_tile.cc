#include "core/kinematics/pose_tile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glog/logging.h>

#include "core/math/rotation.h"

namespace dhcal {
namespace {

static_assert(simd::kThetaSlot == static_cast<int>(JointSlot::kTheta));
static_assert(simd::kDSlot == static_cast<int>(JointSlot::kD));
static_assert(simd::kASlot == static_cast<int>(JointSlot::kA));
static_assert(simd::kAlphaSlot == static_cast<int>(JointSlot::kAlpha));
static_assert(simd::kBetaSlot == static_cast<int>(JointSlot::kBeta));
static_assert(simd::kSlotsPerJoint == SlotLayout::kPerJoint);
static_assert(simd::kSlotsPerFrame == SlotLayout::kPerFrame);
static_assert(SlotLayout(3).base(0) == 3 * simd::kSlotsPerJoint);
static_assert(SlotLayout(3).tool(0) == SlotLayout(3).base(0) + simd::kSlotsPerFrame);

simd::FrameConstants FrameOf(const Eigen::Isometry3d& X, const Eigen::Matrix<double, 6, 1>& delta) {
  simd::FrameConstants frame;
  const Eigen::Isometry3d perturbed = PerturbFrame<double>(X, delta);
  const Eigen::Vector3d turn = delta.tail<3>();
  Eigen::Vector3d::Map(frame.p) = perturbed.translation();
  Eigen::Matrix3d::Map(frame.R) = perturbed.linear();
  Eigen::Matrix3d::Map(frame.left_jacobian) = LeftJacobianSO3<double>(turn);
  Eigen::Vector3d::Map(frame.turn) = turn;
  Eigen::Matrix3d::Map(frame.R_nominal) = X.linear();
  return frame;
}

/// True if one of the frame's slots has amounts.
bool FrameMoves(const std::vector<const double*>& amounts, int first_slot) {
  const auto first = amounts.begin() + first_slot;
  return std::any_of(first, first + SlotLayout::kPerFrame, [](const double* of_slot) {
    return of_slot != nullptr;
  });
}

}  // namespace

PoseTile::PoseTile(int num_columns, int num_slots, bool with_rotation)
    : rows_(with_rotation ? 2 * kRows : kRows),
      num_columns_(num_columns),
      p_WQ_(kRows),
      R_WQ_(with_rotation ? 9 * kPoses : 0),
      J_(static_cast<std::size_t>(rows_ * num_columns)),
      workspace_(static_cast<std::size_t>(2 * 3 * simd::kLanes * num_columns)),
      amounts_(static_cast<std::size_t>(num_slots)) {}

PoseTileKernel::PoseTileKernel(const RobotModel& robot,
                               std::vector<int> slots,
                               bool with_rotation,
                               const simd::Kernels& kernels)
    : robot_(robot),
      layout_(robot.num_joints()),
      slots_(std::move(slots)),
      with_rotation_(with_rotation),
      columns_(static_cast<std::size_t>(layout_.size()), -1),
      kernels_(&kernels) {
  CHECK_GT(robot.num_joints(), 0);
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    const int slot = slots_[k];
    if (slot < 0) continue;
    CHECK_LT(slot, layout_.size());
    CHECK(!Wanted(slot)) << "slot " << layout_.Name(slot) << " has two columns";
    columns_[static_cast<std::size_t>(slot)] = static_cast<int>(k);
    if (layout_.is_angle(slot)) turns_.push_back(static_cast<int>(k));
  }
}

PoseTile PoseTileKernel::MakeTile() const {
  return {static_cast<int>(slots_.size()), layout_.size(), with_rotation_};
}

void PoseTileKernel::FillCoordinates(const Eigen::Ref<const Eigen::MatrixXd>& q,
                                     double* coordinates) const {
  CHECK_EQ(q.rows(), layout_.num_joints());
  CHECK(q.cols() > 0 && q.cols() <= PoseTile::kPoses);
  for (Eigen::Index joint = 0; joint < q.rows(); ++joint) {
    const JointRow& row = robot_.joints[static_cast<std::size_t>(joint)];
    for (Eigen::Index pose = 0; pose < PoseTile::kPoses; ++pose) {
      const double turn = row.sign * q(joint, std::min(pose, q.cols() - 1));
      const bool revolute = row.type == JointType::kRevolute;
      const Eigen::Index pack = pose / simd::kLanes, lane = pose % simd::kLanes;
      double* of_joint = coordinates + (pack * q.rows() + joint) * 2 * simd::kLanes + lane;
      of_joint[0] = revolute ? std::cos(turn) : turn;
      of_joint[simd::kLanes] = revolute ? std::sin(turn) : 0.0;
    }
  }
}

PoseTileScope PoseTileKernel::Prepare(const EndFrames& ends,
                                      const Eigen::Ref<const Eigen::VectorXd>& delta) const {
  CHECK_EQ(delta.size(), layout_.size());
  PoseTileScope scope;
  for (int joint = 0; joint < layout_.num_joints(); ++joint) {
    const JointRow& row = robot_.joints[static_cast<std::size_t>(joint)];
    const auto of = [&](JointSlot kind) { return delta[layout_.joint(joint, kind)]; };
    simd::JointConstants constants;
    constants.revolute = row.type == JointType::kRevolute;
    constants.theta = row.theta + of(JointSlot::kTheta);
    constants.d = row.d + of(JointSlot::kD);
    constants.a = row.a + of(JointSlot::kA);
    constants.alpha = row.alpha + of(JointSlot::kAlpha);
    constants.beta = row.beta + of(JointSlot::kBeta);
    constants.turns_y = constants.beta != 0 || Wanted(layout_.joint(joint, JointSlot::kBeta));
    constants.cos_theta = std::cos(constants.theta);
    constants.sin_theta = std::sin(constants.theta);
    constants.cos_alpha = std::cos(constants.alpha);
    constants.sin_alpha = std::sin(constants.alpha);
    constants.cos_beta = std::cos(constants.beta);
    constants.sin_beta = std::sin(constants.beta);
    scope.joints.push_back(constants);
  }
  scope.base = FrameOf(ends.X_WB, delta.segment<6>(layout_.base(0)));
  scope.tool = FrameOf(ends.X_TQ, delta.segment<6>(layout_.tool(0)));
  return scope;
}

void PoseTileKernel::Evaluate(const PoseTileInput& input, PoseTile* tile) const {
  CHECK_EQ(tile->num_columns_, static_cast<Eigen::Index>(slots_.size()));
  CHECK_EQ(tile->R_WQ_.empty(), !with_rotation_);
  std::fill(tile->amounts_.begin(), tile->amounts_.end(), nullptr);
  for (const SlotAmounts& amounts : input.amounts) {
    const double*& of_slot = tile->amounts_[static_cast<std::size_t>(amounts.slot)];
    CHECK(of_slot == nullptr) << "slot " << layout_.Name(amounts.slot) << " has two amounts";
    of_slot = amounts.amount;
  }
  simd::PoseTileArgs args;
  args.num_joints = layout_.num_joints();
  args.standard = robot_.convention == DhConvention::kStandard;
  args.joints = input.scope->joints.data();
  args.base = &input.scope->base;
  args.tool = &input.scope->tool;
  args.coordinates = input.coordinates;
  args.amounts = tile->amounts_.data();
  args.base_moves = FrameMoves(tile->amounts_, layout_.base(0));
  args.tool_moves = FrameMoves(tile->amounts_, layout_.tool(0));
  args.columns = columns_.data();
  args.turns = turns_.data();
  args.num_turns = static_cast<int>(turns_.size());
  args.p_WQ = tile->p_WQ_.data();
  args.R_WQ = with_rotation_ ? tile->R_WQ_.data() : nullptr;
  args.J_p = tile->J_.data();
  args.J_w = with_rotation_ ? tile->J_.data() + PoseTile::kRows : nullptr;
  args.stride = tile->rows_;
  args.workspace = tile->workspace_.data();
  kernels_->pose_tile(args);
}

}  // namespace dhcal
