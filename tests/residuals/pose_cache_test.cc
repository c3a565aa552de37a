#include "residuals/pose_cache.h"

#include <cmath>
#include <vector>

#include <ceres/problem.h>
#include <gtest/gtest.h>

#include "residuals/position.h"
#include "tests/residuals/cached_rows.h"

namespace dhcal {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

VectorXd RandomState(const CachedRows& rows, Rng* rng) {
  VectorXd x(rows.num_states());
  for (double& value : x) value = rng->Uniform(-0.1, 0.1);
  return x;
}

/// All rows stand at `x`, as freshly computed.
void ExpectAt(const VectorXd& x, bool with_derivatives, const CachedRows& rows, CachedRows* fresh) {
  fresh->MoveTo(x, with_derivatives);
  for (int row_idx = 0; row_idx < rows.cache.num_rows(); ++row_idx) {
    // The two ways to the pose, with derivatives and without, differ by roundings.
    EXPECT_THAT(rows.cache.p_WQ(row_idx), MatrixNear(fresh->cache.p_WQ(row_idx), 1e-14));
    EXPECT_THAT(rows.cache.R_WQ(row_idx), MatrixNear(fresh->cache.R_WQ(row_idx), 1e-14));
    if (!with_derivatives) continue;
    EXPECT_THAT(rows.cache.J_p(row_idx), MatrixNear(fresh->cache.J_p(row_idx), 0));
    EXPECT_THAT(rows.cache.J_w(row_idx), MatrixNear(fresh->cache.J_w(row_idx), 0));
  }
}

TEST(PoseCache, HoldsTheChainsPosesAtTheState) {
  Rng rng(1);
  CachedRows rows(Kr15(), 4, &rng);
  const VectorXd x = RandomState(rows, &rng);
  rows.MoveTo(x, true);
  Rng same(1);
  for (int row_idx = 0; row_idx < 4; ++row_idx) {
    const VectorXd q = RandomJoints(Kr15(), &same);
    const Scope& scope = rows.cache.scope(row_idx);
    VectorXd delta = VectorXd::Zero(rows.chain.slots().size());
    for (std::size_t k = 0; k < scope.slots.size(); ++k) {
      delta[scope.slots[k]] = x[scope.parameters[k]];
    }
    PoseWithDerivatives pose;
    rows.chain.PoseAndDerivatives(q, delta, scope.ends, &pose);
    EXPECT_EQ(Vector3d(rows.cache.p_WQ(row_idx)), pose.p_WQ);
    EXPECT_EQ(rows.cache.R_WQ(row_idx), pose.R_WQ);
    EXPECT_THAT(rows.cache.J_p(row_idx), MatrixNear(pose.J_p, 0));
    EXPECT_THAT(rows.cache.J_w(row_idx), MatrixNear(pose.J_w, 0));
  }
}

TEST(PoseCache, ComputesNothingTwiceAtTheSameState) {
  Rng rng(2);
  CachedRows rows(Kr15(), 2, &rng);
  const VectorXd x = RandomState(rows, &rng);
  for (const bool with_derivatives : {false, true}) {
    rows.MoveTo(x, with_derivatives);
    const Vector3d p = rows.cache.p_WQ(0);
    // Another robot in the chain's place: whatever is computed from here on shows it.
    rows.chain = DhChain(Ur10());
    rows.cache.PrepareForEvaluation(false, true);
    rows.cache.PrepareForEvaluation(false, false);
    if (with_derivatives) rows.cache.PrepareForEvaluation(true, true);
    EXPECT_EQ(Vector3d(rows.cache.p_WQ(0)), p);
    VectorXd elsewhere = x;
    elsewhere[0] += 1e-3;
    rows.MoveTo(elsewhere, with_derivatives);
    EXPECT_GT((rows.cache.p_WQ(0) - p).norm(), 0.1);
    rows.chain = DhChain(Kr15());
  }
}

TEST(PoseCache, ComputesDerivativesWhenOnlyPosesStandAtTheState) {
  Rng rng(3), same(3);
  CachedRows rows(Ur10(), 3, &rng), fresh(Ur10(), 3, &same);
  const VectorXd x = RandomState(rows, &rng);
  rows.MoveTo(x, false);
  rows.MoveTo(x, true);
  ExpectAt(x, true, rows, &fresh);
}

TEST(PoseCache, HasTheRightDerivativesAfterALookElsewhereWithoutThem) {
  Rng rng(4), same(4);
  CachedRows rows(Ur10(), 3, &rng), fresh(Ur10(), 3, &same);
  const VectorXd here = RandomState(rows, &rng), there = RandomState(rows, &rng);
  rows.MoveTo(here, true);
  rows.MoveTo(there, false);  // a step that is tried and rejected
  ExpectAt(there, false, rows, &fresh);
  rows.MoveTo(here, false);
  ExpectAt(here, false, rows, &fresh);
  rows.MoveTo(here, true);
  ExpectAt(here, true, rows, &fresh);
  rows.MoveTo(there, true);
  ExpectAt(there, true, rows, &fresh);
}

TEST(PoseCache, KeepsMeansWithThePosesThroughALookElsewhere) {
  Rng rng(5), same(5);
  CachedRows rows(Scara(), 6, &rng), fresh(Scara(), 6, &same);
  const RunningMeans means({-1, -1, 0, 1, 2, 3}, VectorXd::LinSpaced(6, 1, 2));
  rows.cache.EnableRunningMeans(means);
  fresh.cache.EnableRunningMeans(means);
  const VectorXd here = RandomState(rows, &rng), there = RandomState(rows, &rng);
  rows.MoveTo(here, true);
  rows.MoveTo(there, false);
  rows.MoveTo(here, true);
  fresh.MoveTo(here, true);
  const auto columns = static_cast<Eigen::Index>(rows.cache.scope(4).parameters.size());
  EXPECT_THAT(rows.cache.means().p_mean(4), MatrixNear(fresh.cache.means().p_mean(4), 0));
  EXPECT_THAT(rows.cache.means().J_mean(4, columns),
              MatrixNear(fresh.cache.means().J_mean(4, columns), 0));
}

TEST(PoseCache, AddsParametersOfTheSameSlot) {
  const DhChain chain(OneArm());
  std::vector<double> state = {0.3, 0.4};
  PoseCache cache(&chain,
                  {Scope{EndFrames(), {0, 1}, {0, 0}}},
                  {{VectorXd::Zero(1), 0, {}, {}}},
                  &state,
                  false);
  cache.PrepareForEvaluation(true, true);
  EXPECT_THAT(cache.p_WQ(0), MatrixNear(Vector3d(std::cos(0.7), std::sin(0.7), 0), 1e-15));
  EXPECT_EQ(Vector3d(cache.J_p(0).col(0)), Vector3d(cache.J_p(0).col(1)));
}

/// Counts how often Ceres asks.
class CountingCallback : public ceres::EvaluationCallback {
 public:
  explicit CountingCallback(PoseCache* cache) : cache_(cache) {}
  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override {
    ++count;
    cache_->PrepareForEvaluation(evaluate_jacobians, new_evaluation_point);
  }
  int count = 0;

 private:
  PoseCache* cache_;
};

TEST(PoseCache, IsFilledOncePerEvaluationOfAllBlocks) {
  OneArmRows rows({0.0, 0.5, 1.0, 1.5});
  CountingCallback callback(&rows.cache);
  ceres::Problem::Options options;
  options.evaluation_callback = &callback;
  ceres::Problem problem(options);
  for (int row_idx = 0; row_idx < 4; ++row_idx) {
    problem.AddResidualBlock(
        new PositionResidual(&rows.cache, row_idx, Vector3d::Zero(), 1.0), nullptr, &rows.state[0]);
  }
  std::vector<double> gradient;
  double cost = 0;
  ASSERT_TRUE(problem.Evaluate({}, &cost, nullptr, &gradient, nullptr));
  EXPECT_EQ(callback.count, 1);
  EXPECT_NEAR(cost, 2.0, 1e-15);  // four points at distance 1
}

}  // namespace
}  // namespace dhcal
