// Whitened rows [J, r] of a model's readings at any state, evaluated in tiles of poses.
//
//   r = (h(x) - y) / sigma                 one row per coordinate of a reading, unit variance
//   J = dh/d twist * d twist / d x / sigma
//
// A tile holds up to 64 poses of one run and target, each pose once: two readings that share a pose
// (adjacent pairs) share its evaluation, and the kinematics runs on the processor's vectors
// (core/kinematics/pose_tile.h). Between evaluations only the sines of the joint angles are kept,
// so that memory does not grow with rows times parameters.
#ifndef DHCAL_RESIDUALS_READING_ROWS_H_
#define DHCAL_RESIDUALS_READING_ROWS_H_

#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/kinematics/dh_chain.h"
#include "core/kinematics/pose_tile.h"
#include "core/math/row_reduction.h"
#include "core/model/reading.h"
#include "core/model/recording.h"
#include "core/model/robot.h"
#include "core/simd/aligned.h"
#include "residuals/measurement.h"
#include "residuals/series.h"

namespace dhcal {

/// What is the same for all rows of one run and target: the nominal frames at the chain's ends
/// and the parameters that these rows depend on.
struct Scope {
  EndFrames ends;
  std::vector<int> parameters;  // indices into the state, ascending
  std::vector<int> slots;       // slot that each of them is added to; -1 = an effect's
};

/// What an effect's parameter adds to a slot (core/physics/effect.h).
struct EffectTerm {
  int parameter = 0;              // index into the state
  int slot = 0;                   // [rad or m]
  const Eigen::VectorXd* weight;  // per recording row; slot's unit per unit of the parameter
};

/// What effects with given values add to a slot.
struct HeldTerm {
  int slot = 0;
  const Eigen::VectorXd* amount;  // per recording row [rad or m]
};

/// All that rows depend on. What it points to must outlive the rows.
struct ReadingModel {
  const RobotModel* robot = nullptr;
  const Recording* recording = nullptr;
  const Measurement* measurement = nullptr;
  int num_unknowns = 0;
  std::vector<Scope> scopes;
  std::vector<int> scope_of_row;  // per recording row
  std::vector<EffectTerm> effects;
  std::vector<HeldTerm> held;
  std::vector<Reading> readings;
};

/// What whitens rows.
struct RowNoise {
  Eigen::VectorXd sigma;        // [m] per recording row
  double sigma_rotation = 1.0;  // [rad] one component
  bool shared = false;          // a pose's error enters both pairs that it is in
};

/// Rows of the readings of one tile, those of a coordinate together: the row of coordinate c of
/// the tile's reading i is c * readings.size() + i.
class TileRows {
 public:
  /// [J, r], rows x (num_unknowns + 1); columns start at the alignment of the SIMD kernels.
  Eigen::Map<Eigen::MatrixXd, Eigen::Unaligned, Eigen::OuterStride<>> rows() {
    return {values_.data(), num_rows_, num_cols_, Eigen::OuterStride<>(stride_)};
  }
  Eigen::Map<const Eigen::MatrixXd, Eigen::Unaligned, Eigen::OuterStride<>> rows() const {
    return {values_.data(), num_rows_, num_cols_, Eigen::OuterStride<>(stride_)};
  }
  auto J() { return rows().leftCols(num_cols_ - 1); }
  auto J() const { return rows().leftCols(num_cols_ - 1); }
  auto r() { return rows().col(num_cols_ - 1); }
  auto r() const { return rows().col(num_cols_ - 1); }
  /// The same for the reduction.
  RowTile tile() const { return {values_.data(), num_rows_, stride_, nullptr}; }

  std::vector<int> readings;  // indices into ReadingModel::readings

 private:
  friend class ReadingRows;
  void Resize(Eigen::Index rows, Eigen::Index cols);

  Eigen::Index num_rows_ = 0, num_cols_ = 1, stride_ = 0;
  simd::AlignedDoubles values_;
};

class ReadingRows {
 public:
  explicit ReadingRows(ReadingModel model);

  const ReadingModel& model() const { return model_; }
  int num_readings() const { return static_cast<int>(model_.readings.size()); }
  int num_coordinates() const { return model_.measurement->kind().num_coordinates(); }
  int num_unknowns() const { return model_.num_unknowns; }
  int num_tiles() const { return static_cast<int>(tiles_.size()); }

  /// Tiles that may be visited by themselves; with shared noise those of a series must be visited
  /// in order, so all are one stretch. Stretches are cut at the same tiles whatever the number of
  /// processors.
  std::vector<std::pair<int, int>> Stretches(bool shared) const;

  /// Evaluates tiles [first, last) at the state `x` (num_unknowns) and hands each to `visit`.
  /// False where a reading cannot be evaluated or is not finite.
  bool Visit(const Eigen::VectorXd& x,
             const RowNoise& noise,
             std::pair<int, int> stretch,
             const std::function<void(const TileRows&)>& visit) const;
  /// The same for all tiles.
  bool Visit(const Eigen::VectorXd& x,
             const RowNoise& noise,
             const std::function<void(const TileRows&)>& visit) const {
    return Visit(x, noise, {0, num_tiles()}, visit);
  }
  /// Poses alone: of every reading its own and, where it has one, that of the row before.
  void VisitPoses(
      const Eigen::VectorXd& x,
      const std::function<void(int reading, const SeenPose& now, const SeenPose* before)>& visit)
      const;

 private:
  /// Readings whose poses fit into one tile.
  struct Tile {
    int scope = 0;
    std::vector<int> readings;
    std::vector<int> rows;         // of the recording, each pose once
    std::vector<int> now, before;  // per reading, index into `rows`; before -1 = none
    bool contiguous = true;        // now[i] = now[0] + i and before[i] = now[i] - 1 (or all -1)
    simd::AlignedDoubles coordinates;
  };
  /// The kinematics of a scope's rows: a column per parameter (none for those of effects), then
  /// those of further slots that effects move.
  struct ScopeKernel {
    std::unique_ptr<PoseTileKernel> kernel;
    std::vector<int> column_of_slot;  // -1 = no column
  };
  struct Workspace;
  using OpenSeries = std::map<int, SeriesWhitener>;  // by the recording row that ends it so far

  void MakeKernels();
  void PlanTiles();
  void CloseTile(Tile* tile);
  Eigen::VectorXd ScopeDeltas(int scope, const Eigen::VectorXd& x) const;
  void EvaluatePoses(const Tile& tile, const Eigen::VectorXd& x, Workspace* work) const;
  bool Compare(const Tile& tile, const RowNoise& noise, Workspace* work, TileRows* rows) const;
  /// J of a tile: derivatives by twist, times the twists of the parameters.
  void AddTwists(const Tile& tile, bool pairs, const Workspace& work, TileRows* rows) const;
  void WhitenSeries(const RowNoise& noise,
                    const Tile& tile,
                    OpenSeries* series,
                    TileRows* rows) const;

  ReadingModel model_;
  std::vector<int> effect_slots_;  // that effects or held amounts move, ascending
  std::vector<ScopeKernel> kernels_;
  std::vector<Tile> tiles_;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_READING_ROWS_H_
