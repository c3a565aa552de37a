#include "core/math/truncated_svd.h"

#include <cmath>
#include <limits>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/matchers.h"
#include "tests/support/random_matrix.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSvdRounding = 1e-14;  // a few roundings of numbers of size one

VectorXd RandomVector(int size, Rng* rng) { return RandomMatrix(size, 1, rng); }

/// Columns 0 and 1 equal, column 2 apart: the sum of x0 and x1 is all that can be known.
MatrixXd TwoEqualColumns() {
  MatrixXd J(3, 3);
  J << 1, 1, 0, 2, 2, 0, 0, 0, 3;
  return J;
}

// As a head over a dozen edges gives it: of each edge's columns two are zero, but for rounding far
// below any number of size one.
TEST(TruncatedSvd, ManyColumnsWithSomeOfRoundingHaveFiniteDirections) {
  Rng rng(4);
  constexpr int kColumns = 120;
  MatrixXd J = RandomMatrix(kColumns, kColumns, &rng).triangularView<Eigen::Upper>();
  for (int k = 24; k < kColumns; k += 6) {
    J.col(k) *= 0;
    J.col(k + 1) *= std::pow(10.0, -4.0 * k);
  }
  const TruncatedSvd svd = DecomposeScaled(J, VectorXd::Ones(kColumns));
  ASSERT_TRUE(svd.U.allFinite() && svd.s.allFinite() && svd.V.allFinite());
  // Rounding: machine precision times columns times the largest singular value, 20.
  EXPECT_THAT(svd.U * svd.s.asDiagonal() * svd.V.transpose(), MatrixNear(J, 6e-13));
}

TEST(TruncatedSvd, ReproducesTheScaledMatrix) {
  Rng rng(1);
  const MatrixXd J = RandomMatrix(6, 4, &rng);
  const Eigen::Vector4d scale(1, 0.1, 3, 0.02);
  const TruncatedSvd svd = DecomposeScaled(J, scale);
  EXPECT_THAT(svd.U * svd.s.asDiagonal() * svd.V.transpose(),
              MatrixNear(J * scale.asDiagonal(), kSvdRounding));
  EXPECT_EQ(svd.rank, 4);
  for (int i = 0; i + 1 < 4; ++i) EXPECT_GE(svd.s[i], svd.s[i + 1]);
}

TEST(TruncatedSvd, SolvesFullRankProblemsWhateverTheScale) {
  Rng rng(2);
  const MatrixXd J = RandomMatrix(9, 4, &rng);
  const VectorXd b = RandomVector(9, &rng);
  const VectorXd expected = J.householderQr().solve(b);
  for (const Eigen::Vector4d& scale :
       {Eigen::Vector4d(1, 1, 1, 1), Eigen::Vector4d(1e-3, 5, 0.2, 1)}) {
    const TruncatedSvd svd = DecomposeScaled(J, scale);
    EXPECT_THAT(svd.Solve(b), MatrixNear(expected, 1e-12));  // condition of J diag(scale): 1e4
  }
}

TEST(TruncatedSvd, SharesWhatCannotBeToldApartEqually) {
  TruncatedSvd svd = DecomposeScaled(TwoEqualColumns(), VectorXd::Ones(3));
  SetCut(1e-12, &svd);
  EXPECT_EQ(svd.rank, 2);
  // x0 + x1 = 4 and 3 x2 = 6 reproduce b; the shortest x halves the sum.
  EXPECT_THAT(svd.Solve(Eigen::Vector3d(4, 8, 6)),
              MatrixNear(Eigen::Vector3d(2, 2, 2), kSvdRounding));
}

TEST(TruncatedSvd, SharesByTheSquaresOfTheScales) {
  // Shortest in x / scale: x0 : x1 = scale0^2 : scale1^2 = 9 : 1.
  TruncatedSvd svd = DecomposeScaled(TwoEqualColumns(), Eigen::Vector3d(3, 1, 1));
  SetCut(1e-12, &svd);
  EXPECT_THAT(svd.Solve(Eigen::Vector3d(4, 8, 6)),
              MatrixNear(Eigen::Vector3d(3.6, 0.4, 2), kSvdRounding));
}

TEST(TruncatedSvd, CountsASingularValueAtTheCutAsZero) {
  TruncatedSvd svd = DecomposeScaled(Eigen::Vector3d(4, 2, 1).asDiagonal(), VectorXd::Ones(3));
  SetCut(2.0, &svd);
  EXPECT_EQ(svd.rank, 1);
  SetCut(std::nextafter(2.0, 0.0), &svd);
  EXPECT_EQ(svd.rank, 2);
  SetCut(0.0, &svd);
  EXPECT_EQ(svd.rank, 3);
}

TEST(TruncatedSvd, WithNothingKeptTakesNoStep) {
  TruncatedSvd svd = DecomposeScaled(TwoEqualColumns(), VectorXd::Ones(3));
  SetCut(std::numeric_limits<double>::infinity(), &svd);
  EXPECT_EQ(svd.rank, 0);
  const Eigen::Vector3d b(1, 2, 2);
  EXPECT_EQ(svd.Solve(b), Eigen::Vector3d::Zero());
}

TEST(TruncatedSvd, SplitsTheColumnsIntoSeenAndUnseenDirections) {
  TruncatedSvd svd = DecomposeScaled(TwoEqualColumns(), Eigen::Vector3d(3, 1, 1));
  SetCut(1e-12, &svd);
  const MatrixXd dropped = svd.dropped();
  ASSERT_EQ(dropped.cols(), 1);
  EXPECT_THAT(TwoEqualColumns() * svd.scale.asDiagonal() * dropped,
              MatrixNear(VectorXd::Zero(3), kSvdRounding));
  EXPECT_THAT(svd.kept().transpose() * dropped, MatrixNear(VectorXd::Zero(2), kSvdRounding));
  EXPECT_THAT(dropped.transpose() * dropped, MatrixNear(MatrixXd::Ones(1, 1), kSvdRounding));
}

TEST(TruncatedSvd, FindsSmallSingularValuesToTheRoundingOfTheLargest) {
  Rng rng(4);
  const MatrixXd U = Eigen::HouseholderQR<MatrixXd>(RandomMatrix(4, 4, &rng)).householderQ();
  const MatrixXd V = Eigen::HouseholderQR<MatrixXd>(RandomMatrix(4, 4, &rng)).householderQ();
  const Eigen::Vector4d s(1, 1e-5, 1e-10, 0);
  const TruncatedSvd svd = DecomposeScaled(U * s.asDiagonal() * V.transpose(), VectorXd::Ones(4));
  EXPECT_THAT(svd.s, MatrixNear(s, 2e-15));
}

}  // namespace
}  // namespace dhcal
