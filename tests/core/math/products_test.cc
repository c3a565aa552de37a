#include "core/math/products.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/matchers.h"
#include "tests/support/random_matrix.h"
#include "tests/support/simd_levels.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;

// Rows and columns that do and do not fill packs, panels and pieces.
constexpr int kRowCounts[] = {1, 8, 13, 256, 600};
constexpr int kCols[] = {1, 3, 4, 35, 70};

class ProductsOnALevel : public testing::TestWithParam<const simd::Kernels*> {};

TEST_P(ProductsOnALevel, AreThoseOfEigen) {
  Rng rng(31);
  for (const int rows : kRowCounts) {
    for (const int cols : kCols) {
      const MatrixXd A = RandomMatrix(rows, cols, &rng);
      for (const int others : kCols) {
        const MatrixXd B = RandomMatrix(rows, others, &rng);
        const MatrixXd C = RandomMatrix(cols, others, &rng);
        EXPECT_THAT(TransposedProduct(A, B, *GetParam()), MatrixNear(A.transpose() * B, 1e-11));
        EXPECT_THAT(Deducted(B, A, C, *GetParam()), MatrixNear(B - A * C, 1e-11));
        EXPECT_THAT(TallProduct(A, C, *GetParam()), MatrixNear(A * C, 1e-11));
      }
      const MatrixXd square = A.transpose() * A + MatrixXd::Identity(cols, cols);
      const Eigen::LLT<MatrixXd> factor(square);
      const MatrixXd C = RandomMatrix(cols, 5, &rng);
      EXPECT_THAT(factor.matrixL() * DividedByRoot(factor, C, *GetParam()), MatrixNear(C, 1e-11));
      EXPECT_THAT(SquareOf(A, *GetParam()), MatrixNear(A.transpose() * A, 1e-11));
    }
  }
}

TEST_P(ProductsOnALevel, HaveTheSameBitsAsTheBaseline) {
  Rng rng(32);
  const simd::Kernels& baseline = *simd::SupportedKernels().front();
  const MatrixXd A = RandomMatrix(533, 67, &rng), B = RandomMatrix(533, 43, &rng);
  const MatrixXd C = RandomMatrix(67, 43, &rng);
  EXPECT_TRUE(SameBits(TransposedProduct(A, B, *GetParam()), TransposedProduct(A, B, baseline)));
  EXPECT_TRUE(SameBits(SquareOf(A, *GetParam()), SquareOf(A, baseline)));
  EXPECT_TRUE(SameBits(Deducted(B, A, C, *GetParam()), Deducted(B, A, C, baseline)));
  EXPECT_TRUE(SameBits(OrthonormalColumns(A, *GetParam()), OrthonormalColumns(A, baseline)));
}

INSTANTIATE_TEST_SUITE_P(Levels, ProductsOnALevel, EveryLevel(), LevelName);

TEST(Products, TakeColumnsOfLargerMatrices) {
  Rng rng(33);
  const MatrixXd A = RandomMatrix(40, 9, &rng);
  const MatrixXd top = A.topRows(21);
  EXPECT_TRUE(SameBits(SquareOf(A.topRows(21)), SquareOf(top)));
  EXPECT_TRUE(SameBits(TransposedProduct(A.topRows(21), A.block(19, 3, 21, 4)),
                       TransposedProduct(top, MatrixXd(A.block(19, 3, 21, 4)))));
}

TEST(Products, OfNoColumnsAreEmpty) {
  const MatrixXd none(12, 0), some = MatrixXd::Ones(12, 2);
  EXPECT_EQ(TransposedProduct(none, some).rows(), 0);
  EXPECT_EQ(TransposedProduct(some, none).cols(), 0);
  EXPECT_EQ(SquareOf(none).size(), 0);
  EXPECT_EQ(OrthonormalColumns(none).cols(), 0);
  EXPECT_TRUE(SameBits(Deducted(some, none, MatrixXd(0, 2)), some));
}

TEST(OrthonormalColumns, SpanWhatHouseholdersDo) {
  Rng rng(34);
  MatrixXd A = RandomMatrix(700, 60, &rng);
  // Each column but the first nearly depends on the one before it.
  for (int k = 1; k < A.cols(); ++k) A.col(k) = A.col(k - 1) + 1e-6 * A.col(k);
  A *= A.colwise().norm().cwiseInverse().asDiagonal();
  const MatrixXd Q = OrthonormalColumns(A);
  EXPECT_THAT(Q.transpose() * Q, MatrixNear(MatrixXd::Identity(60, 60), 1e-13));
  const MatrixXd left = A - Q * (Q.transpose() * A);
  // Rounding of the divisions by three roots; Householder would leave a digit or two less.
  EXPECT_LT(left.norm(), 1e-11);
  const MatrixXd other =
      Eigen::HouseholderQR<MatrixXd>(A).householderQ() * MatrixXd::Identity(A.rows(), A.cols());
  // The direction of a column beside those before it is known to rounding over 1e-6.
  const MatrixXd same = (Q.transpose() * other).cwiseAbs();
  EXPECT_THAT(same, MatrixNear(MatrixXd::Identity(60, 60), 1e-8));
}

TEST(OrthonormalColumns, OfADependentColumnAreStillOrthonormal) {
  Rng rng(35);
  MatrixXd A = RandomMatrix(300, 12, &rng);
  A.col(7) = A.col(2) + A.col(3);
  A *= A.colwise().norm().cwiseInverse().asDiagonal();
  const MatrixXd Q = OrthonormalColumns(A);
  EXPECT_THAT(Q.transpose() * Q, MatrixNear(MatrixXd::Identity(12, 12), 1e-10));
}

}  // namespace
}  // namespace dhcal
