// The law that binds the diagnosis to the solver: both weigh the same rows.
#ifndef DHCAL_TESTS_SUPPORT_SAME_ROWS_H_
#define DHCAL_TESTS_SUPPORT_SAME_ROWS_H_

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "core/solver/linearization.h"
#include "problems/assembly.h"
#include "problems/calibration.h"
#include "problems/diagnosis/design_rows.h"

namespace dhcal {

/// At corrections of 0.1 mrad and 0.1 mm, normal equations, squares and freedom of the rows are
/// those of the residual blocks.
inline void ExpectRowsOfTheResidualBlocks(const Calibration& c, const Noise& noise) {
  const Eigen::VectorXd state =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(c.parameters.size()), 1e-4);
  CalibrationProblem problem(c, noise);
  problem.set_state(state);
  Linearization linear;
  ASSERT_TRUE(Linearize(&problem, &linear));
  const DesignRows rows(c, state, noise, c.readings.fitted);
  const Eigen::MatrixXd J = rows.Geometry(c.parameters);
  const Eigen::MatrixXd normal = linear.R.transpose() * linear.R;
  const Eigen::VectorXd right = linear.R.transpose() * linear.b;
  EXPECT_LT((J.transpose() * J - normal).norm(), 1e-9 * normal.norm());
  EXPECT_LT((J.transpose() * rows.y() - right).norm(), 1e-9 * right.norm());
  EXPECT_NEAR(rows.y().squaredNorm(), 2 * linear.cost, 1e-9 * linear.cost);
  // A difference holds as many readings as a pose; a series of shared ones has as many rows more,
  // and offsets that take them away again.
  EXPECT_EQ(rows.degrees_of_freedom(),
            static_cast<int>(c.readings.fitted.size()) * c.measurement->kind().num_coordinates());
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_SAME_ROWS_H_
