// Rules of CalibrationProblem that belong to one kind of problem: shared readings, losses, priors,
// rows that are left out.
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>
#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include "core/solver/linearization.h"
#include "problems/assembly.h"
#include "residuals/registry.h"
#include "tests/problems/assembly_scenario.h"
#include "tests/support/matchers.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// [J, r] of the readings at a state.
MatrixXd Rows(CalibrationProblem* problem, const VectorXd& state) {
  problem->set_state(state);
  problem->PreparedProbe();
  const RowCache& cache = problem->cache();
  EXPECT_TRUE(cache.valid());
  MatrixXd rows(0, state.size() + 1);
  for (int block = 0; block < cache.num_blocks(); ++block) {
    rows.conservativeResize(rows.rows() + cache.block_rows(block), Eigen::NoChange);
    rows.bottomRows(cache.block_rows(block)) = cache.block(block);
  }
  return rows;
}

ScenarioOptions Shared(bool row_sigmas) {
  ScenarioOptions options;
  options.robot = Ur10();
  options.kind = KindNamed("adjacent_position");
  options.num_rows = 30;
  options.two_runs = options.base_per_run = options.targets = true;
  options.shared_pose = true;
  options.row_sigmas = row_sigmas;
  return options;
}

TEST(SharedPoseProblem, IsGeneralisedLeastSquaresOfTheDifferences) {
  for (const bool row_sigmas : {false, true}) {
    SCOPED_TRACE(testing::Message() << "sigma per row " << row_sigmas);
    const Noise noise{0.3, 1.0};
    const auto scenario = MakeScenario(Shared(row_sigmas));
    const VectorXd state = -0.5 * scenario->truth;
    CalibrationProblem shared(*scenario->calibration, noise);
    const MatrixXd whitened = Rows(&shared, state);

    // The differences as they are, one coordinate after the other.
    ProblemSpec plain_spec = scenario->spec;
    plain_spec.measurement.noise = NoiseKind::kIndependent;
    Recording plain_recording = scenario->recording;
    plain_recording.sigma.resize(0);
    const Calibration plain(plain_spec, plain_recording);
    CalibrationProblem differences(plain, Noise{1.0, 1.0});
    const MatrixXd raw = Rows(&differences, state);
    ASSERT_EQ(raw.rows(), whitened.rows());

    const std::vector<Reading>& pairs = plain.readings.fitted;
    const auto num_pairs = static_cast<Eigen::Index>(pairs.size());
    MatrixXd D = MatrixXd::Zero(num_pairs, 30);
    VectorXd sigma(30);
    for (int row = 0; row < 30; ++row) sigma[row] = scenario->calibration->RowSigma(row, noise);
    for (Eigen::Index k = 0; k < num_pairs; ++k) {
      D(k, pairs[static_cast<std::size_t>(k)].row_idx) = 1;
      D(k, pairs[static_cast<std::size_t>(k)].previous_idx) = -1;
    }
    const Eigen::LLT<MatrixXd> covariance(D * sigma.cwiseAbs2().asDiagonal() * D.transpose());
    MatrixXd expected = MatrixXd::Zero(raw.cols(), raw.cols());
    for (int coordinate = 0; coordinate < 3; ++coordinate) {
      const MatrixXd A = raw(Eigen::seqN(coordinate, num_pairs, 3), Eigen::all);
      expected += A.transpose() * covariance.solve(A);
    }
    // J' Sigma^-1 J, J' Sigma^-1 r and r' Sigma^-1 r at once.
    EXPECT_THAT(whitened.transpose() * whitened,
                MatrixNear(expected, 1e-10 * expected.lpNorm<Eigen::Infinity>()));
  }
}

TEST(SharedPoseProblem, WithAnchoredFirstPosesHasTheRowsOfAbsolutePositions) {
  for (const bool displacements : {false, true}) {
    SCOPED_TRACE(testing::Message() << "displacements " << displacements);
    const Noise noise{0.3, 1.0};
    ScenarioOptions options = Shared(/*row_sigmas=*/true);
    options.displacements = displacements;
    const auto scenario = MakeScenario(options);
    ProblemSpec spec = scenario->spec;
    spec.measurement.kind = KindNamed("position");
    spec.measurement.noise = NoiseKind::kIndependent;
    Recording positions = scenario->recording;
    if (displacements) {
      // First rows alone have a position; the others follow from the displacements.
      positions.p_WQ = Eigen::MatrixXd::Zero(30, 3);
      for (const Reading& reading : scenario->calibration->readings.fitted) {
        positions.p_WQ.row(reading.row_idx) =
            positions.p_WQ.row(reading.previous_idx) + positions.displacement.row(reading.row_idx);
      }
      positions.displacement.resize(0, 0);
      scenario->recording.p_WQ = positions.p_WQ;
    }
    const Calibration absolute(spec, positions);
    CalibrationProblem plain(absolute, noise);
    scenario->spec.measurement.anchored = true;
    const Calibration pairs(scenario->spec, scenario->recording);
    ASSERT_EQ(pairs.readings.fitted.size(), 30u);
    CalibrationProblem anchored(pairs, noise);
    const VectorXd state = -0.5 * scenario->truth;
    EXPECT_THAT(Rows(&anchored, state), MatrixNear(Rows(&plain, state), 1e-12));
  }
}

double Rho(LossKind kind, double scale, double square) {
  double rho[3];
  switch (kind) {
    case LossKind::kNone:
      return square;
    case LossKind::kHuber:
      ceres::HuberLoss(scale).Evaluate(square, rho);
      return rho[0];
    case LossKind::kCauchy:
      ceres::CauchyLoss(scale).Evaluate(square, rho);
      return rho[0];
    case LossKind::kTukey:
      ceres::TukeyLoss(scale).Evaluate(square, rho);
      return rho[0];
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(RobustLoss, ActsOnWholeReadingsAndNotOnPriors) {
  ScenarioOptions options;
  options.robot = Kr15();
  const auto scenario = MakeScenario(options);
  scenario->spec.parameters.prior_sigma = {{"theta", 1e-3}};
  scenario->spec.solver.loss_scale = 0.2;
  for (const LossKind loss :
       {LossKind::kNone, LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey}) {
    SCOPED_TRACE(static_cast<int>(loss));
    scenario->spec.solver.loss = loss;
    const Calibration calibration(scenario->spec, scenario->recording);
    CalibrationProblem without(calibration, Noise{0.3, 1.0}, /*with_loss=*/false);
    const VectorXd r = Rows(&without, scenario->truth * 0.3).rightCols(1);
    double expected = 0;
    bool beyond = false, within = false;
    for (Eigen::Index block = 0; block < r.size(); block += 3) {
      const double square = r.segment<3>(block).squaredNorm();
      (square > 0.04 ? beyond : within) = true;
      expected += 0.5 * Rho(loss, 0.2, square);
    }
    ASSERT_TRUE(beyond && within) << "the loss must bend some blocks and not others";
    for (Eigen::Index k = 0; k < 6; ++k) expected += 0.5 * std::pow(without.state()[k] / 1e-3, 2);

    CalibrationProblem with(calibration, Noise{0.3, 1.0});
    with.set_state(scenario->truth * 0.3);
    double cost = std::numeric_limits<double>::quiet_NaN();
    ASSERT_TRUE(with.problem()->Evaluate({}, &cost, nullptr, nullptr, nullptr));
    EXPECT_NEAR(cost, expected, 1e-12 * expected);
    // The cost that solvers compare and report is the same.
    Linearization linearization;
    ASSERT_TRUE(Linearize(&with, &linearization));
    EXPECT_NEAR(linearization.cost, expected, 1e-12 * expected);
  }
}

TEST(Priors, PullCorrectionsToZeroAndSetTheirScale) {
  ScenarioOptions options;
  options.robot = Kr15();
  options.estimate = {"theta", "a"};
  const auto scenario = MakeScenario(options);
  scenario->spec.parameters.prior_sigma = {{"a", 2e-4}, {"a2", 1e-4}, {"theta3", 1e-3}};
  const Calibration calibration(scenario->spec, scenario->recording);
  CalibrationProblem problem(calibration, Noise{});
  ASSERT_EQ(problem.priors().size(), 1u);
  problem.set_state(VectorXd::Constant(12, 1e-3));
  VectorXd r(7);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J(7, 12);
  double* jacobian = J.data();
  ASSERT_TRUE(problem.PreparedProbe()->EvaluateResidualBlockAssumingParametersUnchanged(
      problem.priors()[0], true, nullptr, r.data(), &jacobian));
  // theta3, then a1 to a6.
  VectorXd expected(7);
  expected << 1, 5, 10, 5, 5, 5, 5;
  EXPECT_THAT(r, MatrixNear(expected, 1e-13));
  MatrixXd slopes = MatrixXd::Zero(7, 12);
  slopes(0, 2) = 1e3;
  for (int k = 0; k < 6; ++k) slopes(1 + k, 6 + k) = k == 1 ? 1e4 : 5e3;
  EXPECT_THAT(J, MatrixNear(slopes, 1e-10));
  EXPECT_EQ(problem.scales.tolerance[7], 1e-4);
}

TEST(CalibrationProblem, TakesTargetsByNameWhicheverTheRecordingHasFirst) {
  ScenarioOptions options;
  options.robot = Kr15();
  options.targets = true;
  options.recorded_targets = {"B", "A"};
  const auto scenario = MakeScenario(options);
  CalibrationProblem problem(*scenario->calibration, Noise{});
  const VectorXd r = Rows(&problem, scenario->truth).rightCols(1);
  EXPECT_THAT(r, MatrixNear(VectorXd::Zero(36), 1e-13));
}

TEST(CalibrationProblem, LeavesOutTestRowsAndBlankRows) {
  ScenarioOptions options;
  options.robot = Kr15();
  const auto scenario = MakeScenario(options);
  const VectorXd state = VectorXd::Zero(scenario->truth.size());
  CalibrationProblem all(*scenario->calibration, Noise{});
  const MatrixXd before = Rows(&all, state);
  scenario->recording.is_test.assign(12, false);
  scenario->recording.is_test[4] = true;
  scenario->recording.p_WQ(7, 1) = std::numeric_limits<double>::quiet_NaN();
  const Calibration calibration(scenario->spec, scenario->recording);
  CalibrationProblem fewer(calibration, Noise{});
  const MatrixXd after = Rows(&fewer, state);
  ASSERT_EQ(after.rows(), 30);
  EXPECT_THAT(after.topRows(12), MatrixNear(before.topRows(12), 0));
  EXPECT_THAT(after.middleRows(12, 6), MatrixNear(before.middleRows(15, 6), 0));
  EXPECT_THAT(after.bottomRows(12), MatrixNear(before.bottomRows(12), 0));
}

}  // namespace
}  // namespace dhcal
