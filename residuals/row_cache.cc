#include "residuals/row_cache.h"

#include <atomic>
#include <utility>

#include <glog/logging.h>

#include "core/base/parallel.h"
#include "core/math/row_reduction.h"

namespace dhcal {

RowCache::RowCache(const ReadingRows* rows, RowNoise noise, BlockSize size)
    : rows_(rows),
      noise_(std::move(noise)),
      size_(size),
      stretches_(rows->Stretches(noise_.shared)),
      first_row_{0} {
  const int triangle = rows->num_unknowns() + 1;
  const int blocks =
      size_ == BlockSize::kReading ? rows->num_readings() : static_cast<int>(stretches_.size());
  const int height = size_ == BlockSize::kReading ? rows->num_coordinates() : triangle;
  for (int block = 0; block < blocks; ++block) first_row_.push_back(first_row_.back() + height);
  values_.setZero(first_row_.back(), triangle);
}

void RowCache::Rewhiten(RowNoise noise) {
  CHECK_EQ(noise.shared, noise_.shared);
  noise_ = std::move(noise);
  state_.resize(0);
}

bool RowCache::MoveTo(const Eigen::VectorXd& x) {
  if (state_.size() == x.size() && state_ == x) return valid_;
  state_ = x;
  ++num_evaluations_;
  std::atomic<bool> valid = true;
  ParallelFor(static_cast<int>(stretches_.size()), [&](int stretch) {
    if (!EvaluateStretch(stretch, x)) valid = false;
  });
  valid_ = valid;
  return valid_;
}

bool RowCache::EvaluateStretch(int stretch, const Eigen::VectorXd& x) {
  const Eigen::Index n = num_unknowns();
  const auto tiles = stretches_[static_cast<std::size_t>(stretch)];
  if (size_ == BlockSize::kStretch) {
    RowReduction reduction(static_cast<int>(n) + 1);
    const bool done =
        rows_->Visit(x, noise_, tiles, [&](const TileRows& tile) { reduction.Add(tile.tile()); });
    values_.middleRows(first_row_[static_cast<std::size_t>(stretch)], n + 1) = reduction.R();
    return done;
  }
  return rows_->Visit(x, noise_, tiles, [&](const TileRows& tile) {
    const auto count = static_cast<Eigen::Index>(tile.readings.size());
    for (Eigen::Index i = 0; i < count; ++i) {
      const int first =
          first_row_[static_cast<std::size_t>(tile.readings[static_cast<std::size_t>(i)])];
      for (Eigen::Index c = 0; c < rows_->num_coordinates(); ++c) {
        values_.row(first + c) = tile.rows().row(c * count + i);
      }
    }
  });
}

CachedBlock::CachedBlock(const RowCache* cache, int block_idx)
    : cache_(cache), block_idx_(block_idx) {
  set_num_residuals(cache->block_rows(block_idx));
  mutable_parameter_block_sizes()->push_back(cache->num_unknowns());
}

bool CachedBlock::Evaluate(double const* const* /*parameters*/,
                           double* residuals,
                           double** jacobians) const {
  if (!cache_->valid()) return false;
  const auto rows = cache_->block(block_idx_);
  Eigen::Map<Eigen::VectorXd>(residuals, rows.rows()) = rows.rightCols<1>();
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      jacobians[0], rows.rows(), cache_->num_unknowns()) = rows.leftCols(cache_->num_unknowns());
  return true;
}

}  // namespace dhcal
