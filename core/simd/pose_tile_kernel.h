// Forward kinematics and derivative columns of a tile of poses, kWidth poses at a time. Included by
// the sources kernels_*.cc only. The geometry is that of core/kinematics/dh_chain.cc.
#ifndef DHCAL_CORE_SIMD_POSE_TILE_KERNEL_H_
#define DHCAL_CORE_SIMD_POSE_TILE_KERNEL_H_

#include "core/simd/kernels.h"
#include "core/simd/vec.h"
#include "core/simd/vec3.h"

namespace dhcal::simd {
namespace {

/// sin(t)/t, (1 - cos t)/t^2 and (t - sin t)/t^3 from t^2, as core/math/rotation.h has them.
struct TurnCoefficients {
  Vec sinc, versine, cubic;
};

/// Of one lane whose turn is not small.
DHCAL_INLINE void LargeTurn(int lane, double t2, TurnCoefficients* c) {
  const double t = __builtin_sqrt(t2), s = __builtin_sin(t);
  c->sinc[lane] = s / t;
  c->versine[lane] = (1 - __builtin_cos(t)) / t2;
  c->cubic[lane] = (t - s) / (t2 * t);
}

inline TurnCoefficients CoefficientsOf(Vec t2) {
  // Taylor series to t^16 after the first term: the next one is below 1e-17 for turns up to 1 rad.
  constexpr int kTerms = 8;
  TurnCoefficients c{All(1), All(1), All(1)};
  for (int k = kTerms; k >= 1; --k) {
    c.sinc = 1 - c.sinc * t2 * (1 / (2.0 * k * (2 * k + 1)));
    c.versine = 1 - c.versine * t2 * (1 / ((2.0 * k + 1) * (2 * k + 2)));
    c.cubic = 1 - c.cubic * t2 * (1 / ((2.0 * k + 2) * (2 * k + 3)));
  }
  c.versine = c.versine * 0.5;
  c.cubic = c.cubic * (1 / 6.0);
  for (int lane = 0; lane < kWidth; ++lane) {
    if (t2[lane] > 1) LargeTurn(lane, t2[lane], &c);
  }
  return c;
}

/// I + by_skew [r]x + by_square [r]x^2.
DHCAL_INLINE Axes SkewSeries(const Vec3& r, Vec t2, Vec by_skew, Vec by_square) {
  const Vec3 s = by_skew * r, q = by_square * r;
  const Vec one = 1 - by_square * t2;
  return {{one + q.x * r.x, q.x * r.y + s.z, q.x * r.z - s.y},
          {q.y * r.x - s.z, one + q.y * r.y, q.y * r.z + s.x},
          {q.z * r.x + s.y, q.z * r.y - s.x, one + q.z * r.z}};
}

/// A frame slot's frame at kWidth poses.
struct FrameAtPoses {
  Vec3 p;
  Axes R, left_jacobian;
};

/// What a slot is at the poses `at` ... of the tile.
DHCAL_INLINE Vec SlotAt(const PoseTileArgs& args, int slot, double value, int at) {
  const double* amounts = args.amounts[slot];
  return amounts == nullptr ? All(value) : value + Load(amounts + at);
}

DHCAL_INLINE FrameAtPoses FixedFrame(const FrameConstants& frame) {
  return {All(frame.p), AllAxes(frame.R), AllAxes(frame.left_jacobian)};
}

/// Where poses add to the frame's slots. Kept out of the walk, which should stay in registers.
__attribute__((noinline)) FrameAtPoses FrameWithAmounts(const PoseTileArgs& args,
                                                        const FrameConstants& frame,
                                                        int first_slot,
                                                        int at) {
  const Vec3 r = {SlotAt(args, first_slot + 3, frame.turn[0], at),
                  SlotAt(args, first_slot + 4, frame.turn[1], at),
                  SlotAt(args, first_slot + 5, frame.turn[2], at)};
  const Vec t2 = r.x * r.x + r.y * r.y + r.z * r.z;
  const TurnCoefficients c = CoefficientsOf(t2);
  return {{SlotAt(args, first_slot, frame.p[0], at),
           SlotAt(args, first_slot + 1, frame.p[1], at),
           SlotAt(args, first_slot + 2, frame.p[2], at)},
          SkewSeries(r, t2, c.sinc, c.versine) * AllAxes(frame.R_nominal),
          SkewSeries(r, t2, c.versine, c.cubic)};
}

/// Walks kWidth poses of a tile along the chain.
class PoseWalk {
 public:
  /// `first_pose` within the tile.
  DHCAL_INLINE PoseWalk(const PoseTileArgs& args, int first_pose)
      : args_(args), first_pose_(first_pose) {}

  DHCAL_INLINE void Run() {
    StartAtBase();
    for (int joint = 0; joint < args_.num_joints; ++joint) {
      if (args_.standard) {
        PassStandardRow(joint);
      } else {
        PassModifiedRow(joint);
      }
    }
    EndAtTool();
    Finish();
  }

 private:
  DHCAL_INLINE bool has_amount(int slot) const { return args_.amounts[slot] != nullptr; }
  DHCAL_INLINE Vec At(int slot, double value) const {
    return SlotAt(args_, slot, value, first_pose_);
  }
  DHCAL_INLINE SinCos Angle(double angle, double sin, double cos, int slot) const {
    return has_amount(slot) ? SinCosOf(At(slot, angle)) : SinCos{All(sin), All(cos)};
  }
  DHCAL_INLINE FrameAtPoses FrameAt(const FrameConstants& frame, int first_slot, bool moves) const {
    return moves ? FrameWithAmounts(args_, frame, first_slot, first_pose_) : FixedFrame(frame);
  }
  static DHCAL_INLINE int slot(int joint, int kind) { return kSlotsPerJoint * joint + kind; }

  // Columns of the output. A turn is noted by axis and point until the end point is known.
  DHCAL_INLINE double* note(int column) const {
    return args_.workspace + std::ptrdiff_t{column} * 6 * kLanes;
  }
  DHCAL_INLINE double* J_p(int column) const {
    return args_.J_p + column * args_.stride + first_pose_;
  }
  DHCAL_INLINE double* J_w(int column) const {
    return args_.J_w + column * args_.stride + first_pose_;
  }
  DHCAL_INLINE void Turns(int slot, const Vec3& axis, const Vec3& point) {
    const int column = args_.columns[slot];
    if (column < 0) return;
    Store3(note(column), kLanes, axis);
    Store3(note(column) + 3 * kLanes, kLanes, point);
  }
  DHCAL_INLINE void Shifts(int slot, const Vec3& axis) {
    const int column = args_.columns[slot];
    if (column < 0) return;
    Store3(J_p(column), kTilePoses, axis);
    if (args_.J_w != nullptr) Store3(J_w(column), kTilePoses, Vec3{});
  }

  DHCAL_INLINE void StartAtBase() {
    const int base = kSlotsPerJoint * args_.num_joints;
    const FrameAtPoses frame = FrameAt(*args_.base, base, args_.base_moves);
    axes_ = frame.R;
    o_ = frame.p;
    const Vec zero{}, one = All(1);
    Shifts(base, {one, zero, zero});
    Shifts(base + 1, {zero, one, zero});
    Shifts(base + 2, {zero, zero, one});
    Turns(base + 3, frame.left_jacobian.x, o_);
    Turns(base + 4, frame.left_jacobian.y, o_);
    Turns(base + 5, frame.left_jacobian.z, o_);
  }

  DHCAL_INLINE const double* coordinate(int joint) const {
    const std::ptrdiff_t pack = first_pose_ / kLanes, lane = first_pose_ % kLanes;
    return args_.coordinates + (pack * args_.num_joints + joint) * 2 * kLanes + lane;
  }
  DHCAL_INLINE SinCos Theta(int joint) const {
    const JointConstants& row = args_.joints[joint];
    const SinCos offset = Angle(row.theta, row.sin_theta, row.cos_theta, slot(joint, kThetaSlot));
    if (!row.revolute) return offset;
    const double* q = coordinate(joint);
    const Vec cos_q = Load(q), sin_q = Load(q + kLanes);
    return {sin_q * offset.cos + cos_q * offset.sin, cos_q * offset.cos - sin_q * offset.sin};
  }
  DHCAL_INLINE Vec D(int joint) const {
    const JointConstants& row = args_.joints[joint];
    const Vec d = At(slot(joint, kDSlot), row.d);
    if (row.revolute) return d;
    return d + Load(coordinate(joint));
  }
  DHCAL_INLINE Vec A(int joint) const { return At(slot(joint, kASlot), args_.joints[joint].a); }

  DHCAL_INLINE void TurnTheta(int joint) {
    Turns(slot(joint, kThetaSlot), axes_.z, o_);
    Shifts(slot(joint, kDSlot), axes_.z);
    Turn(Theta(joint), &axes_.x, &axes_.y);
  }
  DHCAL_INLINE void TurnAlpha(int joint) {
    const JointConstants& row = args_.joints[joint];
    const int alpha = slot(joint, kAlphaSlot);
    Turns(alpha, axes_.x, o_);
    Turn(Angle(row.alpha, row.sin_alpha, row.cos_alpha, alpha), &axes_.y, &axes_.z);
  }
  DHCAL_INLINE void TurnBeta(int joint) {
    const JointConstants& row = args_.joints[joint];
    const int beta = slot(joint, kBetaSlot);
    if (!row.turns_y && !has_amount(beta)) return;
    Turns(beta, axes_.y, o_);
    Turn(Angle(row.beta, row.sin_beta, row.cos_beta, beta), &axes_.z, &axes_.x);
  }

  DHCAL_INLINE void PassStandardRow(int joint) {
    TurnTheta(joint);
    o_ = o_ + D(joint) * axes_.z + A(joint) * axes_.x;
    Shifts(slot(joint, kASlot), axes_.x);
    TurnAlpha(joint);
    TurnBeta(joint);
  }
  DHCAL_INLINE void PassModifiedRow(int joint) {
    Shifts(slot(joint, kASlot), axes_.x);
    // The twist's axis is that of the shift, so its point may lie before or after it.
    o_ = o_ + A(joint) * axes_.x;
    TurnAlpha(joint);
    TurnBeta(joint);
    TurnTheta(joint);
    o_ = o_ + D(joint) * axes_.z;
  }

  DHCAL_INLINE void EndAtTool() {
    const int tool = kSlotsPerJoint * args_.num_joints + kSlotsPerFrame;
    const FrameAtPoses frame = FrameAt(*args_.tool, tool, args_.tool_moves);
    Shifts(tool, axes_.x);
    Shifts(tool + 1, axes_.y);
    Shifts(tool + 2, axes_.z);
    o_ = o_ + axes_ * frame.p;
    for (int k = 0; k < 3; ++k) {
      const Vec3& w = k == 0   ? frame.left_jacobian.x
                      : k == 1 ? frame.left_jacobian.y
                               : frame.left_jacobian.z;
      if (args_.columns[tool + 3 + k] >= 0) Turns(tool + 3 + k, axes_ * w, o_);
    }
    Store3(args_.p_WQ + first_pose_, kTilePoses, o_);
    if (args_.R_WQ == nullptr) return;
    const Axes R = axes_ * frame.R;
    Store3(args_.R_WQ + first_pose_, kTilePoses, R.x);
    Store3(args_.R_WQ + 3 * kTilePoses + first_pose_, kTilePoses, R.y);
    Store3(args_.R_WQ + 6 * kTilePoses + first_pose_, kTilePoses, R.z);
  }

  /// Replaces axes and points by the movement of the end point.
  DHCAL_INLINE void Finish() {
    for (int k = 0; k < args_.num_turns; ++k) {
      const int column = args_.turns[k];
      const Vec3 axis = Load3(note(column), kLanes);
      const Vec3 point = Load3(note(column) + 3 * kLanes, kLanes);
      Store3(J_p(column), kTilePoses, Cross(axis, o_ - point));
      if (args_.J_w != nullptr) Store3(J_w(column), kTilePoses, axis);
    }
  }

  const PoseTileArgs& args_;
  int first_pose_;
  Axes axes_;  // of the frame reached
  Vec3 o_;     // its origin
};

void EvaluatePoseTile(const PoseTileArgs& args) {
  for (int first = 0; first < kTilePoses; first += kWidth) PoseWalk(args, first).Run();
}

}  // namespace
}  // namespace dhcal::simd

#endif  // DHCAL_CORE_SIMD_POSE_TILE_KERNEL_H_
