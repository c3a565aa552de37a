#include "core/math/row_reduction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/math/tsqr.h"
#include "tests/support/matchers.h"
#include "tests/support/random_matrix.h"
#include "tests/support/simd_levels.h"
#include "tests/support/triangle.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd Reduced(const MatrixXd& A,
                 int chunk,
                 const simd::Kernels& kernels = simd::ActiveKernels()) {
  RowReduction reduction(static_cast<int>(A.cols()), kernels);
  for (Eigen::Index first = 0; first < A.rows(); first += chunk) {
    reduction.Add(A.middleRows(first, std::min<Eigen::Index>(chunk, A.rows() - first)));
  }
  EXPECT_EQ(reduction.num_rows(), A.rows());
  return reduction.R();
}

MatrixXd ByHouseholder(const MatrixXd& A) {
  Tsqr tsqr(static_cast<int>(A.cols()));
  tsqr.Add(A);
  return tsqr.R();
}

MatrixXd Orthonormal(int rows, int cols, Rng* rng) {
  return Eigen::HouseholderQR<MatrixXd>(RandomMatrix(rows, cols, rng)).householderQ() *
         MatrixXd::Identity(rows, cols);
}

VectorXd SingularValues(const MatrixXd& R) {
  return Eigen::JacobiSVD<MatrixXd>(R).singularValues();
}

/// R'R = A'A, each entry to a rounding of its columns' lengths.
void ExpectSameGram(const MatrixXd& R, const MatrixXd& A) {
  VectorXd inverse_length = A.colwise().norm().transpose();
  for (double& length : inverse_length) length = length > 0 ? 1 / length : 1;
  const MatrixXd found = R * inverse_length.asDiagonal();
  const MatrixXd expected = A * inverse_length.asDiagonal();
  EXPECT_TRUE(R.isUpperTriangular(0.0));
  EXPECT_THAT(found.transpose() * found, MatrixNear(expected.transpose() * expected, 1e-13));
}

TEST(RowReduction, KeepsTheGramMatrixForAnyNumberOfRowsAndColumns) {
  Rng rng(1);
  for (const int cols : {1, 2, 3, 4, 5, 7, 8, 25, 26}) {
    // Around the first sample (4 per column), blocks of 96, packs of 8; many.
    for (const int rows :
         {1, cols, 4 * cols - 1, 4 * cols, 4 * cols + 9, 96, 97, 200, 1001, 5000}) {
      SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(cols));
      const MatrixXd A = RandomMatrix(rows, cols, &rng);
      ExpectSameGram(Reduced(A, rows), A);
      ExpectSameGram(Reduced(A, 50), A);
    }
  }
}

TEST(RowReduction, IsHouseholdersTriangle) {
  Rng rng(2);
  const MatrixXd A = RandomMatrix(20000, 25, &rng);
  const MatrixXd expected = WithPositiveDiagonal(ByHouseholder(A));
  // Entries are of size sqrt(20000).
  EXPECT_THAT(WithPositiveDiagonal(Reduced(A, 192)), MatrixNear(expected, 1e-11));
}

TEST(RowReduction, KeepsWeakDirectionsOfBadlyScaledColumns) {
  // Columns of lengths 1e5 ... 1e-7, and between them angles down to 1e-3.
  Rng rng(3);
  const int cols = 25;
  const VectorXd length =
      VectorXd::LinSpaced(cols, 5, -7).unaryExpr([](double power) { return std::pow(10, power); });
  const VectorXd spread =
      VectorXd::LinSpaced(cols, 0, -3).unaryExpr([](double power) { return std::pow(10, power); });
  const MatrixXd A = Orthonormal(6000, cols, &rng) * spread.asDiagonal() *
                     Orthonormal(cols, cols, &rng) * length.asDiagonal();
  const VectorXd found = SingularValues(Reduced(A, 192));
  const VectorXd expected = SingularValues(ByHouseholder(A));
  int compared = 0;
  for (Eigen::Index k = 0; k < cols; ++k) {
    if (expected[k] < 1e-10 * expected[0]) continue;
    EXPECT_NEAR(found[k] / expected[k], 1, 1e-9) << k;
    ++compared;
  }
  EXPECT_GT(compared, 15);
  // The plain Gram matrix has lost them.
  const VectorXd plain = SingularValues(A.transpose() * A).cwiseSqrt();
  EXPECT_GT(std::abs(plain[compared - 1] / expected[compared - 1] - 1), 1e-3);
}

TEST(RowReduction, KeepsSingularValuesAsWellAsHouseholderDoes) {
  // Along directions that all columns share, a number of 16 digits keeps a share of 1e-16 of the
  // largest value, in the rows themselves.
  Rng rng(4);
  const int cols = 13;
  const VectorXd s =
      VectorXd::LinSpaced(cols, 5, -7).unaryExpr([](double power) { return std::pow(10, power); });
  const MatrixXd A = Orthonormal(6000, cols, &rng) * s.asDiagonal() * Orthonormal(cols, cols, &rng);
  EXPECT_THAT(SingularValues(Reduced(A, 192)), MatrixNear(s, 1e-15 * s[0]));
}

TEST(RowReduction, TakesColumnsThatAreZeroAtFirst) {
  // Like the parameters of a second run, with sizes far from the others'.
  Rng rng(5);
  MatrixXd A = RandomMatrix(6000, 12, &rng);
  A.topRightCorner(3000, 6).setZero();
  A.col(7) *= 1e-9;
  A.col(8) *= 1e9;
  A.col(10) = A.col(9) + 1e-7 * A.col(10);
  ExpectSameGram(Reduced(A, 192), A);
  const VectorXd found = SingularValues(Reduced(A, 192)),
                 expected = SingularValues(ByHouseholder(A));
  EXPECT_THAT(found.tail(11).cwiseQuotient(expected.tail(11)),
              MatrixNear(VectorXd::Ones(11), 1e-6));
}

TEST(RowReduction, TakesDirectionsThatAppearAndFade) {
  Rng rng(6);
  MatrixXd A = RandomMatrix(8000, 6, &rng);
  A.topRows(4000).col(3) = A.topRows(4000).col(1) + 1e-6 * A.topRows(4000).col(2);
  A.bottomRows(4000).col(4) *= 1e-6;
  A.bottomRows(4000).col(5) = A.bottomRows(4000).col(0);
  ExpectSameGram(Reduced(A, 192), A);
  EXPECT_THAT(SingularValues(Reduced(A, 192)), MatrixNear(SingularValues(ByHouseholder(A)), 1e-11));
}

TEST(RowReduction, SurvivesARowThatOutshinesAllOthers) {
  Rng rng(7);
  MatrixXd A = RandomMatrix(4000, 5, &rng);
  A.row(2000) *= 1e12;
  const VectorXd found = SingularValues(Reduced(A, 192)),
                 expected = SingularValues(ByHouseholder(A));
  EXPECT_NEAR(found[0] / expected[0], 1, 1e-14);
  // The others have lost 12 of 16 digits to it, in Householder's triangle, too.
  EXPECT_THAT(found.tail(4), MatrixNear(expected.tail(4), 1e-3 * expected[1]));
}

TEST(RowReduction, KeepsZeroColumnsExactlyZero) {
  Rng rng(8);
  MatrixXd A = RandomMatrix(3000, 9, &rng);
  for (const int col : {0, 4, 8}) A.col(col).setZero();
  const MatrixXd R = Reduced(A, 192);
  for (const int col : {0, 4, 8}) EXPECT_TRUE(SameBits(R.col(col).cwiseAbs(), VectorXd::Zero(9)));
  ExpectSameGram(R, A);
  EXPECT_TRUE(SameBits(Reduced(MatrixXd::Zero(1000, 3), 100).cwiseAbs(), MatrixXd::Zero(3, 3)));
}

TEST(RowReduction, LeavesDependentColumnsDependent) {
  Rng rng(9);
  MatrixXd A = RandomMatrix(20000, 8, &rng);
  A.col(5) = A.col(1) - 2 * A.col(3);
  A.col(6) = A.col(0);
  const MatrixXd R = Reduced(A, 192);
  ExpectSameGram(R, A);
  EXPECT_LT(SingularValues(R)[6], 1e-12 * SingularValues(R)[0]);
  EXPECT_NEAR(SingularValues(R)[5] / SingularValues(ByHouseholder(A))[5], 1, 1e-12);
}

TEST(RowReduction, GoesOnAfterTheTriangleWasRead) {
  Rng rng(10);
  const MatrixXd A = RandomMatrix(900, 6, &rng);
  RowReduction reduction(6);
  for (Eigen::Index first = 0; first < A.rows(); first += 9) {
    reduction.Add(A.middleRows(first, 9));
    ExpectSameGram(reduction.R(), A.topRows(first + 9));
  }
}

TEST(RowReduction, OfNothingIsZero) {
  RowReduction reduction(3);
  EXPECT_EQ(reduction.R(), MatrixXd::Zero(3, 3));
  reduction.Add(MatrixXd(0, 3));
  EXPECT_EQ(reduction.R(), MatrixXd::Zero(3, 3));
}

TEST(RowReduction, WeighsRows) {
  Rng rng(11);
  const MatrixXd A = RandomMatrix(1003, 7, &rng);
  const VectorXd weight = RandomMatrix(1003, 1, &rng).cwiseAbs();
  RowReduction reduction(7);
  reduction.Add({A.data(), A.rows(), A.outerStride(), weight.data()});
  EXPECT_TRUE(SameBits(reduction.R(), Reduced(weight.asDiagonal() * A, 1003)));
}

TEST(RowReduction, SaysWhenANumberIsNone) {
  Rng rng(12);
  for (const double none : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const int row : {3, 700, 999}) {
      MatrixXd A = RandomMatrix(1000, 4, &rng);
      A(row, 2) = none;
      EXPECT_FALSE(Reduced(A, 100).allFinite()) << none << " in row " << row;
    }
  }
}

TEST(RowReduction, MergesWhatOthersReduced) {
  Rng rng(13);
  const MatrixXd A = RandomMatrix(1500, 5, &rng);
  // Few rows or many, on either side.
  for (const int first : {0, 2, 700, 1497, 1500}) {
    RowReduction one(5), other(5);
    one.Add(A.topRows(first));
    other.Add(A.bottomRows(1500 - first));
    one.Merge(&other);
    EXPECT_EQ(one.num_rows(), 1500);
    ExpectSameGram(one.R(), A);
  }
}

TEST(ReduceTiles, DoesNotDependOnTheThreads) {
  Rng rng(14);
  const int cols = 9, rows_per_tile = 24;
  for (const int num_tiles : {0, 1, 191, 384, 3000}) {
    SCOPED_TRACE(num_tiles);
    const MatrixXd A = RandomMatrix(rows_per_tile * num_tiles, cols, &rng);
    const auto reduce = [&](int threads) {
      RowReduction all =
          ReduceTiles(cols, num_tiles, threads, [&](int first, int last, RowReduction* part) {
            for (int tile = first; tile < last; ++tile) {
              part->Add(A.middleRows(rows_per_tile * tile, rows_per_tile));
            }
          });
      EXPECT_EQ(all.num_rows(), A.rows());
      return all.R();
    };
    const MatrixXd R = reduce(1);
    if (num_tiles > 0) ExpectSameGram(R, A);
    EXPECT_TRUE(SameBits(reduce(2), R));
    EXPECT_TRUE(SameBits(reduce(5), R));
  }
}

class RowReductionLevels : public testing::TestWithParam<const simd::Kernels*> {};

TEST_P(RowReductionLevels, HaveTheBaselinesBits) {
  Rng rng(15);
  for (const int cols : {1, 3, 4, 6, 11, 25, 40}) {
    SCOPED_TRACE(cols);
    MatrixXd A = RandomMatrix(3001, cols, &rng);
    A.topLeftCorner(1000, 1).setZero();
    EXPECT_TRUE(
        SameBits(Reduced(A, 203, *GetParam()), Reduced(A, 203, *simd::FindKernels("baseline"))));
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, RowReductionLevels, EveryLevel(), LevelName);

}  // namespace
}  // namespace dhcal
