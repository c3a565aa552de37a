#include "core/math/pseudo_root.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The squared share of a column that must be left for it to be used.
constexpr double kSmallestShare = 1e-6;
constexpr Index kManyColumns = 60;

/// Eigen-directions of the matrix scaled to unit norms, above the cut.
MatrixXd EigenRoot(const MatrixXd& S, const VectorXd& norm2) {
  VectorXd scale = norm2.cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * S * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled);
  Index first = 0;
  while (first < scaled.rows() && eigen.eigenvalues()[first] <= kSmallestShare) ++first;
  const Index kept = scaled.rows() - first;
  return scale.asDiagonal() * eigen.eigenvectors().rightCols(kept) *
         eigen.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Exchanges rows and columns a <= b of a symmetric matrix of which only the lower triangle from
/// column a on is used.
void SwapInLower(Index a, Index b, MatrixXd* matrix) {
  if (a == b) return;
  MatrixXd& S = *matrix;
  const Index between = b - a - 1, below = S.rows() - b - 1;
  std::swap(S(a, a), S(b, b));
  S.col(a).segment(a + 1, between).swap(S.row(b).segment(a + 1, between).transpose());
  S.col(a).tail(below).swap(S.col(b).tail(below));
}

/// The same span from a pivoted Cholesky factor, at a twentieth of the cost for hundreds of
/// columns. Columns that the others leave nothing of are not used. (Eigen's LDLT looks at diagonals
/// that it has not brought up to date, so that it may meet a dependent column early.)
MatrixXd PivotedRoot(const MatrixXd& S, const VectorXd& norm2) {
  const VectorXd scale = norm2.cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd left = scale.asDiagonal() * S * scale.asDiagonal();
  const Index size = left.rows();
  MatrixXd L = MatrixXd::Zero(size, size);
  std::vector<Index> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), Index{0});
  Index rank = 0;
  for (; rank < size; ++rank) {
    Index pivot = 0;
    if (left.diagonal().tail(size - rank).maxCoeff(&pivot) <= kSmallestShare) break;
    pivot += rank;
    SwapInLower(rank, pivot, &left);
    L.row(rank).swap(L.row(pivot));
    std::swap(order[static_cast<std::size_t>(rank)], order[static_cast<std::size_t>(pivot)]);
    const Index rest = size - rank - 1;
    L(rank, rank) = std::sqrt(left(rank, rank));
    L.col(rank).tail(rest) = left.col(rank).tail(rest) / L(rank, rank);
    for (Index k = rank + 1; k < size; ++k) {
      left.col(k).tail(size - k) -= L(k, rank) * L.col(rank).tail(size - k);
    }
  }
  const MatrixXd root = L.topLeftCorner(rank, rank)
                            .triangularView<Eigen::Lower>()
                            .transpose()
                            .solve(MatrixXd::Identity(rank, rank));
  MatrixXd F = MatrixXd::Zero(size, rank);
  for (Index k = 0; k < rank; ++k) F.row(order[static_cast<std::size_t>(k)]) = root.row(k);
  return scale.asDiagonal() * F;
}

}  // namespace

MatrixXd PseudoRoot(const MatrixXd& S, const VectorXd& norm2) {
  return S.rows() > kManyColumns ? PivotedRoot(S, norm2) : EigenRoot(S, norm2);
}

}  // namespace dhcal
