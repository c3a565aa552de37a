// The readings linearised in every slot of every pose: whitened rows from which the column of any
// effect is a sum of products, without going through the solver.
//
//   y = (measured - predicted) / sigma
//   column of a parameter = sum over slots of (d reading / d slot) weight(row) / sigma
//
// Rows of adjacent readings hold two poses, each with its own weight. Shared-pose differences are
// treated as the equivalent: positions with one free offset per series (PHYSICS.md N1); everything
// that leaves this class is projected off those offsets already, so that a recording may have any
// number of series. The same derivatives as the residual blocks', which a test compares.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_DESIGN_ROWS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_DESIGN_ROWS_H_

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/kinematics/dh_chain.h"
#include "core/math/slow_noise.h"
#include "core/physics/effect.h"
#include "problems/calibration.h"
#include "problems/diagnosis/rows/read_out.h"

namespace dhcal {

/// What whitens the readings.
struct RowWeights {
  /// Nothing does: rows are in metres and radians, whatever their noise.
  bool as_read = false;
  Noise noise;
  /// Rounding is noise of the joint: a reading's covariance is sigma^2 I + J_q diag(quantum^2 / 12)
  /// J_q', and rows at one of few places share its rounding. Empty where all columns are exact.
  ReadOut read_out;
  /// [rad] Noise that every turning joint's angle has beside its rounding.
  double joint_noise = 0;
  /// Weight of each recording row's squares; empty = 1.
  Eigen::VectorXd weight;
  /// What of the readings' errors wanders within runs, and is taken out. Only for readings of one
  /// pose each: see CanWhiten.
  SlowNoise slow;
};

class DesignRows {
 public:
  /// `deltas` (slots x recording rows): what the model adds to every slot in each row.
  DesignRows(const Calibration& calibration,
             const Eigen::MatrixXd& deltas,
             const RowWeights& weights,
             const std::vector<Reading>& readings);
  /// `readings`: those to use, of the calibration; at `state`.
  DesignRows(const Calibration& calibration,
             const Eigen::VectorXd& state,
             const Noise& noise,
             const std::vector<Reading>& readings);

  /// False where rows hold two poses or a series' offset already.
  static bool CanWhiten(const Calibration& calibration) {
    return !calibration.measurement->kind().pairs;
  }

  int num_rows() const { return static_cast<int>(y_.size()); }
  /// Coordinates per reading; rows come reading by reading.
  int coordinates() const { return coordinates_; }
  int num_readings() const { return num_rows() / coordinates_; }
  /// Row of the recording that a reading is of.
  int recording_row(int reading) const {
    return now_row_[static_cast<std::size_t>(reading) * static_cast<std::size_t>(coordinates_)];
  }
  const Eigen::VectorXd& y() const { return y_; }
  /// Rows less what the free offsets of series take.
  int degrees_of_freedom() const { return num_rows() - coordinates_ * num_series_; }

  /// What rows at a joint's place have in common is known to its rounding only: rows and columns
  /// are v - U diag(shrunk) U' v of what they were, U orthonormal; no columns where there is none.
  const Eigen::MatrixXd& shared() const { return shared_; }
  const Eigen::VectorXd& shrunk() const { return shrunk_; }
  /// V - U diag(shrunk) U' V.
  Eigen::MatrixXd Shrunk(const Eigen::MatrixXd& V) const;

  /// Where the readings stand in their runs.
  ReadingOrder Order() const;
  /// What takes the wandering out of rows and columns; null where nothing wanders.
  const SlowNoiseFilter* slow_filter() const { return slow_ ? &*slow_ : nullptr; }

  /// Whitened column of something that adds `weight` (per recording row) to slots.
  Eigen::VectorXd Column(const std::vector<SlotWeights>& slots) const;
  /// The same of several; rows x columns.
  Eigen::MatrixXd Columns(const std::vector<std::vector<SlotWeights>>& columns) const;
  /// Columns of the calibration's parameters (effects switched on included).
  Eigen::MatrixXd Geometry(const std::vector<Parameter>& parameters) const;

  /// d reading / d slot at the reading's own pose, and (adjacent) at the one before; rows x slots.
  /// In standard deviations, before the slow filter.
  const Eigen::MatrixXd& now() const { return now_; }
  const Eigen::MatrixXd& before() const { return before_; }
  const std::vector<int>& now_row() const { return now_row_; }
  /// d reading / d coordinate of the joints, likewise; rows x joints, once more for the poses
  /// before.
  Eigen::MatrixXd ByJoints() const;
  const std::vector<int>& before_row() const { return before_row_; }

 private:
  PoseWithDerivatives PoseAt(int row) const;
  void TakeOutSlowNoise();
  /// Finds what the rounding of few places gives to the rows, and takes it out.
  void ShrinkSharedRounding();
  /// Columns as they are before what rows share is taken out.
  Eigen::VectorXd OwnColumn(const std::vector<SlotWeights>& slots) const;
  Eigen::MatrixXd OwnColumns(const std::vector<std::vector<SlotWeights>>& columns) const;
  void AddReading(const Reading& reading);
  void AddSeries(const std::vector<Reading>& readings);
  /// Covariance that rounding and noise of joint coordinates give to rows with these derivatives.
  Eigen::MatrixXd OfTheJoints(const Eigen::MatrixXd& J) const;
  double RootWeight(int row) const;
  /// v without what the offsets of the series can take of it.
  void TakeOutOffsets(Eigen::VectorXd* v) const {
    if (num_series_ > 0) *v -= offsets_ * (offsets_.transpose() * *v);
  }
  void Append(const Eigen::VectorXd& y,
              const Eigen::MatrixXd& now,
              int row,
              const Eigen::MatrixXd* before,
              int before_row);

  const Calibration& c_;
  Eigen::MatrixXd deltas_;
  RowWeights weights_;
  int coordinates_;
  int filled_ = 0;
  Eigen::VectorXd y_;
  Eigen::MatrixXd now_, before_;
  std::vector<int> now_row_, before_row_;
  int num_series_ = 0;                   // with shared differences; else none
  Eigen::SparseMatrix<double> offsets_;  // orthonormal
  std::optional<SlowNoiseFilter> slow_;
  Eigen::MatrixXd shared_;  // rows x errors; without a column where there is none
  Eigen::VectorXd shrunk_;
};

/// Root mean square [m] of the lengths among whitened values, unwhitened by each row's own sigma;
/// `recording_row`: of each value. Shared poses count as poses, up to their series' offset. NaN
/// where there are none.
double RmsAsRead(const Calibration& calibration,
                 const Noise& noise,
                 const std::vector<int>& recording_row,
                 const Eigen::VectorXd& whitened);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_DESIGN_ROWS_H_
