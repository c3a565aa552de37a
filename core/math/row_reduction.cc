#include "core/math/row_reduction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/LU>
#include <Eigen/QR>
#include <glog/logging.h>

#include "core/base/parallel.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rows that are divided by U before their products are summed: the quotients stay in the cache.
constexpr Index kPackedRows = 96;
static_assert(kPackedRows % simd::kLanes == 0);
// Rows per column that U is first made from: enough to be of the later ones' kind, and few enough
// that Householder's share is small.
constexpr Index kSampleRows = 4;
// U is renewed when this many times the rows that it stands for have been added.
constexpr std::int64_t kGrowth = 3;
// The squares of the quotients of all rows that are added to one U must not pass this many times
// U's own part: then at most 6 of 16 digits are lost in a direction, and rows like those of U stay
// far below. Rows of a block that break it alone bring a direction that U has not seen.
constexpr double kLargestSum = 1e6;
// U is taken as it is while its diagonal entries are at least this share of their columns; else
// each column gets a row of its own of the second share, far below all that rounding leaves of it.
constexpr double kSafeDiagonal = 1e-12;
constexpr double kOwnRow = 1e-13;
// That row of a column that has been zero: any other number is a direction not seen.
constexpr double kOwnRowOfZero = 1e-100;
// Parts of a reduction: at least so many tiles, for the first rows cost more than the others, and
// at most so many parts.
constexpr int kTilesPerPart = 192;
constexpr int kMostParts = 16;

/// Upper triangle of rows, by Householder, with rows of zeros where there are too few.
MatrixXd Triangle(MatrixXd rows) {
  const Index n = rows.cols();
  MatrixXd R = MatrixXd::Zero(n, n);
  if (rows.rows() == 0) return R;
  const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(rows);
  const Index count = std::min(rows.rows(), n);
  R.topRows(count) = rows.topRows(count).triangularView<Eigen::Upper>();
  return R;
}

MatrixXd Stacked(const MatrixXd& above, const Eigen::Ref<const MatrixXd>& below) {
  MatrixXd rows(above.rows() + below.rows(), above.cols());
  rows << above, below;
  return rows;
}

/// Upper triangle C with C'C = M, M positive semidefinite; a column that depends on those before it
/// gets a row of zeros.
MatrixXd SemidefiniteRoot(const MatrixXd& M) {
  const Index n = M.rows();
  const double rounding = static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  MatrixXd C = MatrixXd::Zero(n, n);
  for (Index k = 0; k < n; ++k) {
    const auto above = C.col(k).head(k);
    const double rest = M(k, k) - above.squaredNorm();
    if (rest <= rounding * M(k, k)) continue;
    C(k, k) = std::sqrt(rest);
    for (Index j = k + 1; j < n; ++j) {
      C(k, j) = (M(k, j) - above.dot(C.col(j).head(k))) / C(k, k);
    }
  }
  return C;
}

/// A tile's rows with their weights, copied.
MatrixXd Copied(const RowTile& tile, Index num_cols) {
  const Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>> rows(
      tile.data, tile.num_rows, num_cols, Eigen::OuterStride<>(tile.stride));
  if (tile.weight == nullptr) return rows;
  return VectorXd::Map(tile.weight, tile.num_rows).asDiagonal() * rows;
}

Index GramBlocks(Index num_cols) {
  const Index blocks = (num_cols + simd::kGramBlock - 1) / simd::kGramBlock;
  return blocks * (blocks + 1) / 2;
}

}  // namespace

RowReduction::RowReduction(int num_cols, const simd::Kernels& kernels)
    : kernels_(&kernels),
      sample_(kSampleRows * num_cols + kPackedRows, num_cols),
      R_(MatrixXd::Zero(num_cols, num_cols)),
      squares_(VectorXd::Zero(num_cols)),
      T_(static_cast<std::size_t>(kPackedRows * num_cols)),
      sums_(static_cast<std::size_t>(GramBlocks(num_cols) * simd::kGramBlock * simd::kGramBlock *
                                     simd::kLanes)) {
  CHECK_GT(num_cols, 0);
}

void RowReduction::Add(const RowTile& tile) {
  num_rows_ += tile.num_rows;
  for (Index first = 0; first < tile.num_rows; first += kPackedRows) {
    RowTile block = tile;
    block.data += first;
    block.num_rows = std::min(kPackedRows, tile.num_rows - first);
    if (tile.weight != nullptr) block.weight += first;
    if (conditioned_) {
      AddBlock(block);
    } else {
      AddSample(Copied(block, num_cols()));
    }
  }
}

void RowReduction::Add(const Eigen::Ref<const MatrixXd>& rows) {
  CHECK_EQ(rows.cols(), num_cols());
  Add({rows.data(), rows.rows(), rows.outerStride(), nullptr});
}

void RowReduction::Merge(RowReduction* other) {
  CHECK_EQ(other->num_cols(), num_cols());
  const MatrixXd& R = other->R();
  num_rows_ += other->num_rows_;
  if (conditioned_) {
    SetApart(R);
    return;
  }
  for (Index first = 0; first < R.rows() && !conditioned_; first += kPackedRows) {
    const Index count = std::min(kPackedRows, R.rows() - first);
    AddSample(R.middleRows(first, count));
  }
}

void RowReduction::AddSample(const Eigen::Ref<const MatrixXd>& rows) {
  sample_.middleRows(sampled_, rows.rows()) = rows;
  sampled_ += rows.rows();
  if (sampled_ < kSampleRows * rows.cols()) return;
  R_ = Triangle(sample_.topRows(sampled_));
  folded_ = sampled_;
  sample_.resize(0, 0);
  conditioned_ = true;
  Condition();
}

void RowReduction::SetApart(const Eigen::Ref<const MatrixXd>& rows) {
  if (num_apart_ + rows.rows() > apart_.rows()) TakeInApart();
  if (apart_.rows() < rows.rows()) apart_.resize(std::max(R_.cols(), rows.rows()), num_cols());
  apart_.middleRows(num_apart_, rows.rows()) = rows;
  num_apart_ += rows.rows();
}

void RowReduction::TakeInApart() {
  if (num_apart_ == 0) return;
  Fold();
  R_ = Triangle(Stacked(R_, apart_.topRows(num_apart_)));
  folded_ += num_apart_;
  num_apart_ = 0;
  Condition();
}

void RowReduction::AddBlock(const RowTile& block) {
  MatrixXd padded;
  RowTile packs = block;
  const Index beyond = block.num_rows % simd::kLanes;
  if (beyond > 0) {
    padded.setZero(block.num_rows + simd::kLanes - beyond, num_cols());
    padded.topRows(block.num_rows) = Copied(block, num_cols());
    packs = {padded.data(), padded.rows(), padded.rows(), nullptr};
  }
  Substitute(packs);
  VectorXd squares = SquaresOfQuotients(packs.num_rows);
  if ((squares.array() > kLargestSum).any()) {
    padded = WithoutRowsOfNewDirections(Copied(block, num_cols()));
    packs = {padded.data(), padded.rows(), padded.rows(), nullptr};
    Substitute(packs);
    squares = SquaresOfQuotients(packs.num_rows);
  }
  if ((squares_ + squares).maxCoeff() > kLargestSum) {
    Fold();
    Condition();
    Substitute(packs);
    squares = SquaresOfQuotients(packs.num_rows);
  }
  squares_ += squares;
  simd::GramArgs args;
  args.num_packs = static_cast<int>(packs.num_rows / simd::kLanes);
  args.num_cols = num_cols();
  args.T = T_.data();
  args.sums = sums_.data();
  kernels_->gram(args);
  unfolded_ += block.num_rows;
  if (unfolded_ < kGrowth * folded_) return;
  Fold();
  Condition();
}

void RowReduction::Substitute(const RowTile& packs) {
  simd::SubstituteArgs args;
  args.num_packs = static_cast<int>(packs.num_rows / simd::kLanes);
  args.num_cols = num_cols();
  args.J = packs.data;
  args.stride = packs.stride;
  args.weight = packs.weight;
  args.U = U_.data();
  args.inverse_diagonal = inverse_diagonal_.data();
  args.T = T_.data();
  kernels_->substitute(args);
}

MatrixXd RowReduction::WithoutRowsOfNewDirections(const MatrixXd& block) {
  MatrixXd others =
      MatrixXd::Zero((block.rows() + simd::kLanes - 1) / simd::kLanes * simd::kLanes, block.cols());
  MatrixXd apart(block.rows(), block.cols());
  Index num_apart = 0;
  for (Index row = 0; row < block.rows(); ++row) {
    const double* const quotients =
        T_.data() + row / simd::kLanes * num_cols() * simd::kLanes + row % simd::kLanes;
    double largest = 0;
    for (Index col = 0; col < num_cols(); ++col) {
      largest = std::max(largest, std::abs(quotients[col * simd::kLanes]));
    }
    if (largest * largest * kPackedRows > kLargestSum) {
      apart.row(num_apart++) = block.row(row);
    } else {
      others.row(row) = block.row(row);
    }
  }
  SetApart(apart.topRows(num_apart));
  return others;
}

VectorXd RowReduction::SquaresOfQuotients(Index rows) const {
  using Lanes = Eigen::Array<double, simd::kLanes, 1>;
  VectorXd squares(num_cols());
  for (Index col = 0; col < num_cols(); ++col) {
    Lanes sum = Lanes::Zero();
    for (Index pack = 0; pack < rows / simd::kLanes; ++pack) {
      sum += Lanes::Map(T_.data() + (pack * num_cols() + col) * simd::kLanes).square();
    }
    squares[col] = sum.sum();
  }
  return squares;
}

MatrixXd RowReduction::Gram() const {
  constexpr Index kBlock = simd::kGramBlock;
  MatrixXd gram(num_cols(), num_cols());
  for (Index row = 0; row < num_cols(); ++row) {
    for (Index col = 0; col <= row; ++col) {
      const Index I = row / kBlock, J = col / kBlock;
      const Index entry =
          (I * (I + 1) / 2 + J) * kBlock * kBlock + row % kBlock * kBlock + col % kBlock;
      const double* lanes = sums_.data() + entry * simd::kLanes;
      double sum = 0;
      for (int lane = 0; lane < simd::kLanes; ++lane) sum += lanes[lane];
      gram(row, col) = gram(col, row) = sum;
    }
  }
  return gram;
}

void RowReduction::Fold() {
  if (unfolded_ == 0) return;
  const MatrixXd C = SemidefiniteRoot(within_.transpose() * within_ + Gram());
  R_ = C * U_.triangularView<Eigen::Upper>();
  R_.triangularView<Eigen::StrictlyLower>().setZero();
  folded_ += unfolded_;
  unfolded_ = 0;
  squares_.setZero();
  std::fill(sums_.begin(), sums_.end(), 0.0);
}

void RowReduction::Condition() {
  const VectorXd length = R_.colwise().norm().transpose();
  const VectorXd diagonal = R_.diagonal().cwiseAbs();
  if ((diagonal.array() >= kSafeDiagonal * length.array() && length.array() > 0).all()) {
    U_ = R_;
    within_.setIdentity(R_.rows(), R_.cols());
  } else {
    const VectorXd own = (kOwnRow * length).cwiseMax(kOwnRowOfZero);
    U_ = Triangle(Stacked(R_, MatrixXd(own.asDiagonal())));
    within_ = U_.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(R_);
  }
  inverse_diagonal_ = U_.diagonal().cwiseInverse();
}

const MatrixXd& RowReduction::R() {
  if (conditioned_) {
    TakeInApart();
    if (unfolded_ > 0) {
      Fold();
      Condition();
    }
    return R_;
  }
  R_ = Triangle(sample_.topRows(sampled_));
  sampled_ = std::min(sampled_, R_.rows());
  sample_.topRows(sampled_) = R_.topRows(sampled_);
  return R_;
}

RowReduction ReduceTiles(int num_cols,
                         int num_tiles,
                         int threads,
                         const std::function<void(int first, int last, RowReduction* part)>& add,
                         const simd::Kernels& kernels) {
  const int num_parts = std::clamp(num_tiles / kTilesPerPart, 1, kMostParts);
  std::vector<RowReduction> parts(static_cast<std::size_t>(num_parts),
                                  RowReduction(num_cols, kernels));
  const auto start = [&](int part) {
    return static_cast<int>(std::int64_t{num_tiles} * part / num_parts);
  };
  ParallelFor(
      num_parts,
      [&](int part) { add(start(part), start(part + 1), &parts[static_cast<std::size_t>(part)]); },
      threads);
  for (std::size_t part = 1; part < parts.size(); ++part) parts[0].Merge(&parts[part]);
  return parts[0];
}

}  // namespace dhcal
