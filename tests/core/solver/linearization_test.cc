#include "core/solver/linearization.h"

#include <vector>

#include <ceres/crs_matrix.h>
#include <gtest/gtest.h>

#include "tests/support/curve_problem.h"

namespace dhcal {
namespace {

TEST(Linearization, TriangleCarriesTheNormalEquationsAndTheCost) {
  CurveCase curve;
  curve.noise_step = 0.01;
  const auto problem = MakeCurveProblem(curve);
  problem->set_state(Eigen::Vector3d(0.05, 0.1, -0.1));
  // The same by Ceres' own evaluation of the whole problem.
  double cost = 0;
  std::vector<double> gradient;
  ceres::CRSMatrix sparse;
  ASSERT_TRUE(problem->problem()->Evaluate({}, &cost, nullptr, &gradient, &sparse));
  const Eigen::Map<Eigen::Matrix<double, 5, 3, Eigen::RowMajor>> J(sparse.values.data());
  Linearization linear;
  ASSERT_TRUE(Linearize(problem.get(), &linear));
  const double scale = (J.transpose() * J).norm();
  EXPECT_LT((linear.R.transpose() * linear.R - J.transpose() * J).norm(), 1e-12 * scale);
  const Eigen::Map<Eigen::Vector3d> g(gradient.data());
  EXPECT_LT((linear.R.transpose() * linear.b + g).norm(), 1e-12 * g.norm());
  EXPECT_NEAR(linear.cost, cost, 1e-12 * cost);
  EXPECT_NEAR(0.5 * (linear.b.squaredNorm() + linear.outside * linear.outside), cost, 1e-10 * cost);
}

TEST(Linearization, IsOfTheStateNotOfWhereASolverHadTheProblem) {
  const auto problem = MakeCurveProblem(CurveCase());
  Linearization first, again;
  ASSERT_TRUE(Linearize(problem.get(), &first));
  problem->set_state(Eigen::Vector3d(0.5, 0.1, -0.1));
  ASSERT_TRUE(Linearize(problem.get(), &again));
  EXPECT_GT((first.R - again.R).norm(), 1e-3 * first.R.norm());
  problem->set_state(Eigen::Vector3d::Zero());
  ASSERT_TRUE(Linearize(problem.get(), &again));
  EXPECT_EQ(first.R, again.R);
}

}  // namespace
}  // namespace dhcal
