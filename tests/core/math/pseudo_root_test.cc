#include "core/math/pseudo_root.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/matchers.h"
#include "tests/support/random_matrix.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The Gram matrix of `size` columns of very different lengths that span `rank` directions; the
/// last are sums of the first ones.
MatrixXd DependentGram(Index size, Index rank) {
  Rng rng(1);
  MatrixXd A = RandomMatrix(3 * size, size, &rng);
  for (Index k = rank; k < size; ++k) A.col(k) = A.col(k - rank) - 2 * A.col(k - rank + 1);
  for (Index k = 0; k < size; ++k) A.col(k) *= k % 2 == 0 ? 1e-3 : 1e4;
  return A.transpose() * A;
}

/// Few columns take the eigenvalues, many the Cholesky factor.
class PseudoRootOf : public testing::TestWithParam<Index> {};

TEST_P(PseudoRootOf, IndependentColumnsIsARootOfTheInverse) {
  const MatrixXd S = DependentGram(GetParam(), GetParam());
  const MatrixXd E = PseudoRoot(S, S.diagonal());
  ASSERT_EQ(E.cols(), S.cols());
  EXPECT_THAT(S * E * E.transpose() * S * 1e-8, MatrixNear(S * 1e-8, 1e-9));
}

TEST_P(PseudoRootOf, DependentColumnsReachesTheWholeSpanOnce) {
  const Index rank = GetParam() - 3;
  const MatrixXd S = DependentGram(GetParam(), rank);
  const MatrixXd E = PseudoRoot(S, S.diagonal());
  ASSERT_EQ(E.cols(), rank);
  EXPECT_THAT(E.transpose() * S * E, MatrixNear(MatrixXd::Identity(rank, rank), 1e-9));
  EXPECT_THAT(S * E * E.transpose() * S * 1e-8, MatrixNear(S * 1e-8, 1e-9));
}

TEST_P(PseudoRootOf, AColumnOfWhichNearlyNothingIsLeftDoesNotUseIt) {
  MatrixXd S = MatrixXd::Identity(GetParam(), GetParam());
  S(1, 1) = 1e-7;
  const MatrixXd E = PseudoRoot(S, VectorXd::Ones(GetParam()));
  EXPECT_EQ(E.cols(), GetParam() - 1);
  EXPECT_EQ(E.row(1).norm(), 0);
}

INSTANTIATE_TEST_SUITE_P(FewAndMany, PseudoRootOf, testing::Values(8, 80));

}  // namespace
}  // namespace dhcal
