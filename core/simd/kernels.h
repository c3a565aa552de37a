// The computations that are compiled once per SIMD level, as a table of functions (SIMD.md).
//
// Plain data only: what this header defines is seen by sources that are compiled for different
// processors, so it must not hold a function or a template that the linker could pick from the
// wrong one.
#ifndef DHCAL_CORE_SIMD_KERNELS_H_
#define DHCAL_CORE_SIMD_KERNELS_H_

#include <cstddef>

namespace dhcal::simd {

/// Poses of a tile; a multiple of every level's vector.
constexpr int kTilePoses = 64;
/// Sums over rows are kept in so many lanes on every level: lane l has rows l, l + 8, l + 16, ...
constexpr int kLanes = 8;
/// Doubles are loaded fastest from this alignment [byte].
constexpr std::size_t kAlignment = 64;

// The order of a chain's slots: core/kinematics/slots.h, which may not be included here.
constexpr int kThetaSlot = 0, kDSlot = 1, kASlot = 2, kAlphaSlot = 3, kBetaSlot = 4;
constexpr int kSlotsPerJoint = 5;
constexpr int kSlotsPerFrame = 6;

/// What one joint's row is for all poses of a scope.
struct JointConstants {
  bool revolute;
  bool turns_y;                     // beta is not zero, or its column is wanted
  double theta, d, a, alpha, beta;  // [rad], [m]: row and the scope's perturbation
  double cos_theta, sin_theta;      // of the above
  double cos_alpha, sin_alpha;
  double cos_beta, sin_beta;
};

/// A frame slot's frame for all poses of a scope; 3 x 3 matrices by columns.
struct FrameConstants {
  double p[3];              // [m], perturbed
  double R[9];              // perturbed: Exp(turn) R_nominal
  double left_jacobian[9];  // of Exp at `turn`
  double turn[3];           // rotation vector [rad]
  double R_nominal[9];
};

/// Poses kTilePoses at a time, in structures of arrays: every quantity is kTilePoses doubles.
struct PoseTileArgs {
  int num_joints;
  bool standard;                 // else modified rows
  const JointConstants* joints;  // num_joints
  const FrameConstants* base;
  const FrameConstants* tool;

  // For kLanes poses at a time, and of these per joint twice kLanes doubles, in the order of use:
  // cos and sin of its turn, or its shift [m] and anything.
  const double* coordinates;
  const double* const* amounts;  // per slot: what each pose adds to it, null = nothing
  const int* columns;            // per slot: its column of the output, -1 = not wanted
  const int* turns;              // the columns of slots that turn, num_turns
  int num_turns;
  bool base_moves, tool_moves;  // one of the frame's slots has amounts

  double* p_WQ;  // 3
  double* R_WQ;  // 9, by columns; null = not wanted
  double* J_p;   // 3 per column, the columns `stride` doubles apart
  double* J_w;   // the same; null = not wanted
  std::ptrdiff_t stride;
  double* workspace;  // 6 * kLanes doubles per column
};

/// T U = J for the rows of a tile, U an upper triangle.
struct SubstituteArgs {
  int num_packs;  // kLanes rows each
  int num_cols;
  const double* J;  // columns `stride` doubles apart
  std::ptrdiff_t stride;
  const double* weight;  // of each row of J; null = 1
  const double* U;       // num_cols x num_cols, by columns
  const double* inverse_diagonal;
  double* T;  // per pack num_cols times kLanes doubles, aligned
};

/// sums += T'T, lane by lane.
struct GramArgs {
  int num_packs;
  int num_cols;
  const double* T;  // as SubstituteArgs writes it
  double* sums;     // GramBlocks(num_cols) blocks, aligned
};

/// products += A'B of some rows, a multiple of kLanes. Columns of each matrix `stride` doubles
/// apart.
struct CrossArgs {
  int num_rows;
  int cols_A, cols_B;
  const double* A;
  std::ptrdiff_t stride_A;
  const double* B;
  std::ptrdiff_t stride_B;
  double* products;  // cols_A x cols_B
  std::ptrdiff_t stride_products;
  bool lower_only;  // of a square product: entries above the diagonal may be left out
};

/// B -= A C, rows of A and B a multiple of kLanes.
struct DeductArgs {
  int num_rows;
  int cols_A, cols_B;
  const double* A;
  std::ptrdiff_t stride_A;
  const double* C;  // cols_A x cols_B
  std::ptrdiff_t stride_C;
  double* B;
  std::ptrdiff_t stride_B;
};

/// Columns are taken four at a time; sums hold 4 x 4 blocks of the lower triangle, row by row of
/// blocks, entries of a block row by row, kLanes doubles each.
constexpr int kGramBlock = 4;

struct Kernels {
  const char* name;  // "baseline"
  void (*pose_tile)(const PoseTileArgs& args);
  void (*substitute)(const SubstituteArgs& args);
  void (*gram)(const GramArgs& args);
  void (*cross)(const CrossArgs& args);
  void (*deduct)(const DeductArgs& args);
};

// Null where the compiler does not know the level. Constants, so that to look at them runs no
// code of a level that the processor may lack.
extern const Kernels* const kBaselineKernels;
extern const Kernels* const kAvx2Kernels;
extern const Kernels* const kAvx512Kernels;

}  // namespace dhcal::simd

#endif  // DHCAL_CORE_SIMD_KERNELS_H_
