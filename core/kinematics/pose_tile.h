// Poses and derivative columns 64 at a time: DhChain::PoseAndDerivatives for large recordings, on
// the processor's vectors (core/simd). Results are the same bits on every SIMD level and agree with
// DhChain to rounding.
#ifndef DHCAL_CORE_KINEMATICS_POSE_TILE_H_
#define DHCAL_CORE_KINEMATICS_POSE_TILE_H_

#include <vector>

#include <Eigen/Core>

#include "core/kinematics/dh_chain.h"
#include "core/kinematics/slots.h"
#include "core/model/robot.h"
#include "core/simd/aligned.h"
#include "core/simd/kernels.h"
#include "core/simd/level.h"

namespace dhcal {

/// What all poses of one scope share at one state: rows and frames with their perturbation, and
/// the sines that these need.
struct PoseTileScope {
  std::vector<simd::JointConstants> joints;
  simd::FrameConstants base, tool;
};

/// What each pose of a tile adds to a slot [rad or m].
struct SlotAmounts {
  int slot = 0;
  const double* amount = nullptr;  // one per pose of the tile
};

/// Poses of one scope. Where a tile has fewer than its 64, the last one stands in for the others.
struct PoseTileInput {
  const PoseTileScope* scope = nullptr;
  const double* coordinates = nullptr;  // PoseTileKernel::FillCoordinates
  std::vector<SlotAmounts> amounts;     // each slot once at most
};

/// The poses of a tile in structures of arrays, and the memory that computing them needs. Rows of
/// the matrices: x of all poses, then y, then z.
class PoseTile {
 public:
  static constexpr int kPoses = simd::kTilePoses;
  static constexpr int kRows = 3 * kPoses;
  using Coordinates = Eigen::Map<const Eigen::Matrix<double, kPoses, 3>>;
  using Rotations = Eigen::Map<const Eigen::Matrix<double, kPoses, 9>>;

  /// `num_columns` of J.
  PoseTile(int num_columns, int num_slots, bool with_rotation);

  /// Position of Q in W [m], a row per pose.
  Coordinates p_WQ() const { return Coordinates(p_WQ_.data()); }
  /// Its orientation, a row per pose, the matrix by columns; only with rotation.
  Rotations R_WQ() const { return Rotations(R_WQ_.data()); }
  Eigen::Matrix3d R_WQ(int pose) const {
    return Eigen::Matrix3d(Eigen::Matrix<double, 1, 9>(R_WQ().row(pose)).data());
  }

  /// Column k: movement of Q per unit of the kernel's slot k, kRows; with rotation as many more
  /// rows below, the turn of Q's frame. Columns without a slot are the caller's: zero, then his.
  Eigen::Map<Eigen::MatrixXd> J() { return {J_.data(), rows_, num_columns_}; }
  Eigen::Map<const Eigen::MatrixXd> J() const { return {J_.data(), rows_, num_columns_}; }
  Eigen::Index num_rows() const { return rows_; }

 private:
  friend class PoseTileKernel;

  Eigen::Index rows_, num_columns_;
  simd::AlignedDoubles p_WQ_, R_WQ_, J_;
  simd::AlignedDoubles workspace_;
  std::vector<const double*> amounts_;  // per slot
};

/// Computes tiles of one robot, always the same columns. Immutable.
class PoseTileKernel {
 public:
  /// `slots`: slot of each column of J, each at most once, -1 = the column is left alone. Without
  /// slots it computes poses only.
  PoseTileKernel(const RobotModel& robot,
                 std::vector<int> slots,
                 bool with_rotation,
                 const simd::Kernels& kernels = simd::ActiveKernels());

  PoseTile MakeTile() const;

  /// Doubles that the coordinates of a tile take.
  int num_coordinates() const { return 2 * PoseTile::kPoses * layout_.num_joints(); }
  /// Prepares joint coordinates as the controller reports them, joints x at most 64 poses, for
  /// all evaluations to come.
  void FillCoordinates(const Eigen::Ref<const Eigen::MatrixXd>& q, double* coordinates) const;

  /// For the perturbation `delta` of every slot.
  PoseTileScope Prepare(const EndFrames& ends,
                        const Eigen::Ref<const Eigen::VectorXd>& delta) const;

  /// Allocates nothing. `tile` is one that MakeTile made.
  void Evaluate(const PoseTileInput& input, PoseTile* tile) const;

 private:
  bool Wanted(int slot) const { return columns_[static_cast<std::size_t>(slot)] >= 0; }

  RobotModel robot_;
  SlotLayout layout_;
  std::vector<int> slots_;
  bool with_rotation_;
  std::vector<int> columns_;  // per slot: its column, -1 = not wanted
  std::vector<int> turns_;    // columns of slots that turn
  const simd::Kernels* kernels_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_KINEMATICS_POSE_TILE_H_
