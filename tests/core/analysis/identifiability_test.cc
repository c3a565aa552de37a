#include "core/analysis/identifiability.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/math/tsqr.h"

namespace dhcal {
namespace {

Linearization FromRows(const Eigen::MatrixXd& J) {
  Eigen::MatrixXd rows(J.rows(), J.cols() + 1);
  rows << J, Eigen::VectorXd::Zero(J.rows());
  Tsqr tsqr(static_cast<int>(rows.cols()));
  tsqr.Add(rows);
  return FromTriangle(tsqr.R());
}

Eigen::MatrixXd RandomRows(int rows, int cols, std::uint64_t seed) {
  Rng rng(seed);
  Eigen::MatrixXd J(rows, cols);
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < cols; ++k) J(i, k) = rng.Normal();
  }
  return J;
}

TEST(Identifiability, CovarianceIsTheInverseOfTheNormalMatrixAtFullRank) {
  const Eigen::MatrixXd J = 50.0 * RandomRows(40, 5, 1);
  const Linearization linear = FromRows(J);
  const Identifiability result = Identify(linear, linear, Eigen::VectorXd::Ones(5), 40);
  const Eigen::MatrixXd expected = (J.transpose() * J).inverse();
  EXPECT_LT((result.covariance - expected).norm(), 1e-12 * expected.norm());
  for (const Determination& d : result.parameters) EXPECT_EQ(d.verdict, Verdict::kIdentified);
}

TEST(Identifiability, CovarianceDoesNotDependOnTheUnitsOfTolerancesAtFullRank) {
  const Eigen::MatrixXd J = 1e4 * RandomRows(40, 3, 2);
  const Linearization linear = FromRows(J);
  const Identifiability one = Identify(linear, linear, Eigen::Vector3d(1, 1, 1), 40);
  const Identifiability other = Identify(linear, linear, Eigen::Vector3d(0.1, 1, 10), 40);
  EXPECT_LT((one.covariance - other.covariance).norm(), 1e-10 * one.covariance.norm());
}

TEST(Identifiability, EqualColumnsAreConfoundedAndKeepTheirToleranceAsSigma) {
  Eigen::MatrixXd J = 100.0 * RandomRows(40, 3, 3);
  J.col(2) = J.col(1);
  const Linearization linear = FromRows(J);
  const Identifiability result = Identify(linear, linear, Eigen::Vector3d(1, 2, 2), 40);
  EXPECT_EQ(result.readings.rank, 2);
  EXPECT_EQ(result.numerical_rank, 2);
  EXPECT_EQ(result.parameters[0].verdict, Verdict::kIdentified);
  EXPECT_EQ(result.parameters[1].verdict, Verdict::kConfounded);
  EXPECT_EQ(result.parameters[2].verdict, Verdict::kConfounded);
  // Half of the variance of each lies in the difference that nothing sees.
  EXPECT_NEAR(std::sqrt(result.covariance(1, 1)), 2 / std::sqrt(2.0), 0.01);
}

TEST(Identifiability, ColumnBelowTheNoiseIsUnobservable) {
  Eigen::MatrixXd J = 100.0 * RandomRows(40, 2, 4);
  J.col(1) *= 1e-3 / 10;
  const Linearization linear = FromRows(J);
  const Identifiability result = Identify(linear, linear, Eigen::Vector2d(1, 1), 40);
  EXPECT_EQ(result.parameters[1].verdict, Verdict::kUnobservable);
  EXPECT_EQ(result.numerical_rank, 2);
  EXPECT_NEAR(std::sqrt(result.covariance(1, 1)), 1.0, 1e-6);
}

TEST(Identifiability, PriorTightensTheCovarianceButNotTheVerdict) {
  Eigen::MatrixXd J = 100.0 * RandomRows(40, 2, 5);
  J.col(1).setZero();
  Eigen::MatrixXd with_prior(41, 2);
  with_prior << J, 0, 1 / 0.2;
  const Identifiability result =
      Identify(FromRows(J), FromRows(with_prior), Eigen::Vector2d(1, 0.2), 40);
  EXPECT_EQ(result.parameters[1].verdict, Verdict::kUnobservable);
  EXPECT_NEAR(std::sqrt(result.covariance(1, 1)), 0.2, 1e-9);
}

TEST(Identifiability, VerdictsFollowTheirWrittenRule) {
  EXPECT_EQ(VerdictOf({1.5, 0, 1, Verdict::kFixed}), Verdict::kUnobservable);
  EXPECT_EQ(VerdictOf({0.1, 0.1, 0.2, Verdict::kFixed}), Verdict::kConfounded);
  EXPECT_EQ(VerdictOf({0.1, 0.3, 0, Verdict::kFixed}), Verdict::kIdentified);
  EXPECT_EQ(VerdictOf({0.1, 0.35, 0, Verdict::kFixed}), Verdict::kWeak);
  // Known well, but a bias of a third of sigma would spoil the interval.
  EXPECT_EQ(VerdictOf({0.01, 0.03, 0.01, Verdict::kFixed}), Verdict::kWeak);
}

TEST(ObservabilityIndices, OfADiagonalJacobianAreTheirFormulas) {
  const Eigen::Vector3d s(8, 4, 2);
  const Eigen::MatrixXd J = s.asDiagonal();
  const Linearization linear = FromRows(J);
  const Identifiability result = Identify(linear, linear, Eigen::Vector3d::Ones(), 4);
  EXPECT_NEAR(result.observability.o1, 4.0 / 2.0, 1e-12);  // cube root of 64, over root of 4 poses
  EXPECT_NEAR(result.observability.o2, 0.25, 1e-12);
  EXPECT_NEAR(result.observability.o3, 2.0, 1e-12);
  EXPECT_NEAR(result.observability.o4, 0.5, 1e-12);
  EXPECT_NEAR(result.observability.o5, 1 / (1 / 8.0 + 1 / 4.0 + 1 / 2.0), 1e-12);
  EXPECT_NEAR(result.condition_number, 4.0, 1e-12);
}

}  // namespace
}  // namespace dhcal
