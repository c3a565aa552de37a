// Rows of a robot in a PoseCache, and residual blocks over them evaluated as Ceres would.
#ifndef DHCAL_TESTS_RESIDUALS_CACHED_ROWS_H_
#define DHCAL_TESTS_RESIDUALS_CACHED_ROWS_H_

#include <algorithm>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/kinematics/dh_chain.h"
#include "residuals/pose_cache.h"
#include "tests/support/matchers.h"
#include "tests/support/ridders.h"
#include "tests/support/robots.h"

namespace dhcal {

/// A block's values; `valid` as it returned.
struct BlockValues {
  bool valid = false;
  Eigen::VectorXd r;
  Eigen::MatrixXd J;  // rows x parameters of the row's scope
};

/// Two runs of rows, each with its own base: every slot of joints and tool is a parameter of both,
/// the base's six are two sets. Even rows belong to the first run, odd ones to the second.
class CachedRows {
 public:
  CachedRows(const RobotModel& robot, int num_rows, Rng* rng)
      : chain(robot),
        state(static_cast<std::size_t>(chain.slots().size() + 6), 0.0),
        cache(
            &chain, Scopes(robot), Rows(robot, num_rows, rng), &state, /*with_orientation=*/true) {}

  /// Moves to `x` and prepares as Ceres does before it evaluates blocks.
  void MoveTo(const Eigen::VectorXd& x, bool with_derivatives) {
    Eigen::Map<Eigen::VectorXd>(state.data(), x.size()) = x;
    cache.PrepareForEvaluation(with_derivatives, true);
  }

  Eigen::VectorXd state_vector() const {
    return Eigen::Map<const Eigen::VectorXd>(state.data(), num_states());
  }
  Eigen::Index num_states() const { return static_cast<Eigen::Index>(state.size()); }

  DhChain chain;
  std::vector<double> state;
  PoseCache cache;

 private:
  static std::vector<Scope> Scopes(const RobotModel& robot) {
    const SlotLayout slots(robot.num_joints());
    std::vector<Scope> scopes(2);
    scopes[0].ends = {robot.X_WB, robot.X_TQ};
    scopes[1].ends = {MakeFrame({-0.2, 0.1, 0.4}, {0.2, 0.1, -2.0}) * robot.X_WB, robot.X_TQ};
    for (int slot = 0; slot < slots.size(); ++slot) {
      for (int run = 0; run < 2; ++run) {
        // The second run's base stands at the end of the state.
        const bool apart = run == 1 && slots.is_base(slot);
        const int parameter = apart ? slots.size() + slot - slots.base(0) : slot;
        scopes[static_cast<std::size_t>(run)].parameters.push_back(parameter);
        scopes[static_cast<std::size_t>(run)].slots.push_back(slot);
      }
    }
    return scopes;
  }

  static std::vector<CacheRow> Rows(const RobotModel& robot, int num_rows, Rng* rng) {
    std::vector<CacheRow> rows;
    for (int row_idx = 0; row_idx < num_rows; ++row_idx) {
      rows.push_back({RandomJoints(robot, rng), row_idx % 2, {}, {}});
    }
    return rows;
  }
};

/// Evaluates a block where its cache stands; outputs are not-a-number beforehand.
inline BlockValues Evaluate(const ceres::CostFunction& block, bool with_derivatives = true) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto num_parameters = static_cast<Eigen::Index>(block.parameter_block_sizes().size());
  BlockValues values;
  values.r.setConstant(block.num_residuals(), kNaN);
  values.J.setConstant(block.num_residuals(), num_parameters, kNaN);
  // Values at the blocks are not read: the cache has them.
  const std::vector<double> unused(static_cast<std::size_t>(num_parameters), kNaN);
  std::vector<const double*> parameters;
  std::vector<double*> columns;
  for (Eigen::Index k = 0; k < num_parameters; ++k) {
    parameters.push_back(&unused[static_cast<std::size_t>(k)]);
    columns.push_back(values.J.col(k).data());
  }
  values.valid = block.Evaluate(
      parameters.data(), values.r.data(), with_derivatives ? columns.data() : nullptr);
  return values;
}

/// The block's Jacobian equals Ridders differences of its residuals at states of size zero, 1e-8
/// and 0.2, and parameters outside the row's scope do not move it.
inline void ExpectRiddersDerivatives(const ceres::CostFunction& block,
                                     int row_idx,
                                     CachedRows* rows,
                                     Rng* rng) {
  for (const double size : {0.0, 1e-8, 0.2}) {
    SCOPED_TRACE(size);
    Eigen::VectorXd x(rows->num_states());
    for (double& value : x) value = rng->Uniform(-size, size);
    const Eigen::MatrixXd numeric = RiddersJacobian(
        [&](const Eigen::VectorXd& moved) {
          rows->MoveTo(moved, false);
          return Evaluate(block, false).r;
        },
        x);
    rows->MoveTo(x, true);
    const BlockValues values = Evaluate(block);
    ASSERT_TRUE(values.valid);
    Eigen::MatrixXd analytic = Eigen::MatrixXd::Zero(numeric.rows(), numeric.cols());
    const std::vector<int>& parameters = rows->cache.scope(row_idx).parameters;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      analytic.col(parameters[k]) = values.J.col(static_cast<Eigen::Index>(k));
    }
    // Ridders' own error, about 1e-11 of functions of this size.
    const double scale = std::max(1.0, analytic.lpNorm<Eigen::Infinity>());
    EXPECT_THAT(analytic, MatrixNear(numeric, 1e-9 * scale));
  }
}

/// One joint at the origin with an arm of 1 m: Q at (cos q, sin q, 0), x along the arm.
inline RobotModel OneArm() {
  RobotModel robot;
  robot.joints.resize(1);
  robot.joints[0].a = 1;
  return robot;
}

/// OneArm at the angles `q` [rad], its theta1 the only parameter.
class OneArmRows {
 public:
  explicit OneArmRows(const std::vector<double>& q)
      : chain(OneArm()), cache(&chain, {Scope{EndFrames(), {0}, {0}}}, Rows(q), &state, true) {
    cache.PrepareForEvaluation(true, true);
  }

  DhChain chain;
  std::vector<double> state{0.0};
  PoseCache cache;

 private:
  static std::vector<CacheRow> Rows(const std::vector<double>& q) {
    std::vector<CacheRow> rows;
    for (const double angle : q) rows.push_back({Eigen::VectorXd::Constant(1, angle), 0, {}, {}});
    return rows;
  }
};

}  // namespace dhcal

#endif  // DHCAL_TESTS_RESIDUALS_CACHED_ROWS_H_
