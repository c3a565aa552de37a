// The residual blocks of a model: what Ceres sees of its readings.
//
// Small recordings, and all with a robust loss, have one block per reading (per pair of adjacent
// poses), since a loss bends whole readings. In large ones a block stands for a stretch of
// thousands of readings and hands Ceres their triangle: the n + 1 rows of the QR factor of [J, r],
// which have the same squares, gradient and curvature as the rows themselves. So neither Ceres nor
// anyone else holds a matrix that grows with the recording.
//
// All blocks are evaluated together, once per state, before Ceres asks for any (its evaluation
// callback): two blocks share each pose of an adjacent pair. Derivatives are always computed, since
// nearly every state that a solver tries it also accepts.
#ifndef DHCAL_RESIDUALS_ROW_CACHE_H_
#define DHCAL_RESIDUALS_ROW_CACHE_H_

#include <utility>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>

#include "residuals/reading_rows.h"

namespace dhcal {

enum class BlockSize {
  kReading,  // one block per reading
  kStretch   // one block per stretch of ReadingRows
};

class RowCache {
 public:
  /// `rows` must outlive the cache.
  RowCache(const ReadingRows* rows, RowNoise noise, BlockSize size);

  int num_blocks() const { return static_cast<int>(first_row_.size()) - 1; }
  int num_unknowns() const { return rows_->num_unknowns(); }
  int block_rows(int block) const {
    return first_row_[static_cast<std::size_t>(block) + 1] -
           first_row_[static_cast<std::size_t>(block)];
  }

  /// Evaluates all blocks at `x` (num_unknowns), unless they stand there already. False where the
  /// model cannot be evaluated.
  bool MoveTo(const Eigen::VectorXd& x);
  /// Other noise from here on.
  void Rewhiten(RowNoise noise);

  /// [J, r] of a block where the cache stands.
  auto block(int block_idx) const {
    return values_.middleRows(first_row_[static_cast<std::size_t>(block_idx)],
                              block_rows(block_idx));
  }
  bool valid() const { return valid_; }
  /// How often all poses have been evaluated.
  int num_evaluations() const { return num_evaluations_; }

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  bool EvaluateStretch(int stretch, const Eigen::VectorXd& x);

  const ReadingRows* rows_;
  RowNoise noise_;
  BlockSize size_;
  std::vector<std::pair<int, int>> stretches_;
  std::vector<int> first_row_;  // per block, and the end
  RowMajor values_;             // [J, r] of all blocks
  Eigen::VectorXd state_;       // where they stand; empty = nowhere
  bool valid_ = false;
  int num_evaluations_ = 0;
};

/// A block of a cache as Ceres' cost function of one dense parameter block.
class CachedBlock final : public ceres::CostFunction {
 public:
  /// The cache must outlive the block.
  CachedBlock(const RowCache* cache, int block_idx);
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override;

 private:
  const RowCache* cache_;
  int block_idx_;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_ROW_CACHE_H_
