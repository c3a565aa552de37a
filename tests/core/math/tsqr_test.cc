#include "core/math/tsqr.h"

#include <algorithm>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/matchers.h"
#include "tests/support/random_matrix.h"
#include "tests/support/triangle.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;

/// Adds A in pieces of `chunk` rows.
MatrixXd ReducedInChunks(const MatrixXd& A, int chunk) {
  Tsqr tsqr(static_cast<int>(A.cols()));
  for (Eigen::Index first = 0; first < A.rows(); first += chunk) {
    tsqr.Add(A.middleRows(first, std::min<Eigen::Index>(chunk, A.rows() - first)));
  }
  EXPECT_EQ(tsqr.num_rows(), A.rows());
  return tsqr.R();
}

TEST(Tsqr, KeepsTheGramMatrixForAnyNumberOfRows) {
  Rng rng(1);
  // Fewer rows than columns, as many, one buffer (512 + columns), one more, several.
  for (const int rows : {1, 3, 7, 8, 519, 520, 2600}) {
    const MatrixXd A = RandomMatrix(rows, 7, &rng);
    const MatrixXd R = ReducedInChunks(A, rows);
    EXPECT_EQ(R.rows(), 7);
    EXPECT_TRUE(R.isUpperTriangular(0.0)) << rows << " rows";
    // Rounding grows at most with the number of rows.
    EXPECT_THAT(R.transpose() * R, MatrixNear(A.transpose() * A, 1e-14 * rows)) << rows << " rows";
  }
}

TEST(Tsqr, DoesNotDependOnHowTheRowsAreCut) {
  Rng rng(2);
  const MatrixXd A = RandomMatrix(1500, 5, &rng);
  const MatrixXd R = WithPositiveDiagonal(ReducedInChunks(A, 1500));
  for (const int chunk : {1, 3, 511, 517, 1499}) {
    // Entries are of size sqrt(1500).
    EXPECT_THAT(WithPositiveDiagonal(ReducedInChunks(A, chunk)), MatrixNear(R, 1e-12)) << chunk;
  }
}

TEST(Tsqr, GoesOnAfterTheTriangleWasRead) {
  Rng rng(3);
  const MatrixXd A = RandomMatrix(40, 6, &rng);
  Tsqr tsqr(6);
  for (Eigen::Index row = 0; row < A.rows(); ++row) {
    tsqr.Add(A.row(row));
    const MatrixXd R = tsqr.R();
    const MatrixXd so_far = A.topRows(row + 1);
    ASSERT_THAT(R.transpose() * R, MatrixNear(so_far.transpose() * so_far, 1e-12)) << row;
  }
}

TEST(Tsqr, OfNothingIsZero) {
  Tsqr tsqr(3);
  EXPECT_EQ(tsqr.R(), MatrixXd::Zero(3, 3));
  tsqr.Add(MatrixXd(0, 3));
  EXPECT_EQ(tsqr.R(), MatrixXd::Zero(3, 3));
  EXPECT_EQ(tsqr.num_rows(), 0);
}

TEST(Tsqr, KeepsSingularValuesThatAGramMatrixLoses) {
  // Known singular values down to 1e-12 of the largest; in A'A their squares, 1e-24, would vanish.
  Rng rng(4);
  const int rows = 3000;
  const MatrixXd U = Eigen::HouseholderQR<MatrixXd>(RandomMatrix(rows, 4, &rng)).householderQ() *
                     MatrixXd::Identity(rows, 4);
  const MatrixXd V = Eigen::HouseholderQR<MatrixXd>(RandomMatrix(4, 4, &rng)).householderQ();
  const Eigen::Vector4d s(1, 1e-4, 1e-8, 1e-12);
  const MatrixXd R = ReducedInChunks(U * s.asDiagonal() * V.transpose(), 700);
  const Eigen::VectorXd found = Eigen::JacobiSVD<MatrixXd>(R).singularValues();
  EXPECT_THAT(found, MatrixNear(s, 2e-15));  // a few roundings of the largest
}

TEST(Tsqr, TakesMoreColumnsThanABlockHasRows) {
  Rng rng(5);
  const MatrixXd A = RandomMatrix(1300, 600, &rng);
  const MatrixXd R = ReducedInChunks(A, 400);
  EXPECT_THAT(R.transpose() * R, MatrixNear(A.transpose() * A, 1e-10));
}

}  // namespace
}  // namespace dhcal
