#include "core/solver/linearization.h"

#include <gtest/gtest.h>

#include "tests/support/curve_problem.h"

namespace dhcal {
namespace {

TEST(Linearization, TriangleCarriesTheNormalEquationsAndTheCost) {
  CurveCase curve;
  curve.noise_step = 0.01;
  const auto problem = MakeCurveProblem(curve);
  problem->set_state(Eigen::Vector3d(0.05, 0.1, -0.1));
  Eigen::MatrixXd J(5, 3);
  Eigen::VectorXd r(5);
  ForEachChunk(problem.get(),
               problem->readings,
               [&](int first, const Eigen::VectorXd& rows, const Eigen::MatrixXd& jacobian) {
                 EXPECT_EQ(first, 0);
                 r = rows;
                 J = jacobian;
               });
  Linearization linear;
  ASSERT_TRUE(Linearize(problem.get(), &linear));
  EXPECT_EQ(linear.num_residuals, 5);
  const double scale = (J.transpose() * J).norm();
  EXPECT_LT((linear.R.transpose() * linear.R - J.transpose() * J).norm(), 1e-12 * scale);
  EXPECT_LT((linear.R.transpose() * linear.b + J.transpose() * r).norm(),
            1e-12 * (J.transpose() * r).norm());
  EXPECT_NEAR(linear.cost(), 0.5 * r.squaredNorm(), 1e-10 * r.squaredNorm());
}

TEST(Linearization, ColumnsAreTheDerivativesOfTheResiduals) {
  const auto problem = MakeCurveProblem(CurveCase());
  problem->set_state(Eigen::Vector3d(0.05, 0.1, -0.1));
  Eigen::MatrixXd J;
  ForEachChunk(problem.get(),
               problem->readings,
               [&](int, const Eigen::VectorXd&, const Eigen::MatrixXd& rows) { J = rows; });
  const double step = 1e-6;
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd plus, minus;
    problem->state[static_cast<std::size_t>(k)] += step;
    ASSERT_TRUE(EvaluateReadings(problem.get(), &plus));
    problem->state[static_cast<std::size_t>(k)] -= 2 * step;
    ASSERT_TRUE(EvaluateReadings(problem.get(), &minus));
    problem->state[static_cast<std::size_t>(k)] += step;
    EXPECT_LT(((plus - minus) / (2 * step) - J.col(k)).norm(), 1e-6 * J.col(k).norm());
  }
}

}  // namespace
}  // namespace dhcal
