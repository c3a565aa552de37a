// Rules of BuildProblem that belong to one kind of problem: shared readings, losses, priors, rows
// that are left out.
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>
#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include "core/solver/linearization.h"
#include "problems/assembly.h"
#include "tests/problems/assembly_scenario.h"
#include "tests/support/matchers.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// [J, r] of the readings at a state.
MatrixXd Rows(EstimationProblem* problem, const VectorXd& state) {
  problem->set_state(state);
  MatrixXd rows;
  EXPECT_TRUE(ForEachChunk(
      problem, problem->readings, [&](int /*first*/, const VectorXd& r, const MatrixXd& J) {
        rows.resize(r.size(), J.cols() + 1);
        rows << J, r;
      }));
  return rows;
}

ScenarioOptions Shared(bool row_sigmas) {
  ScenarioOptions options;
  options.robot = Ur10();
  options.kind = MeasurementKind::kAdjacentPosition;
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
    const auto shared = BuildProblem(*scenario->calibration, noise);
    const MatrixXd whitened = Rows(shared.get(), state);

    // The differences as they are, one coordinate after the other.
    ProblemSpec plain_spec = scenario->spec;
    plain_spec.measurement.noise = NoiseKind::kIndependent;
    Recording plain_recording = scenario->recording;
    plain_recording.sigma.resize(0);
    const Calibration plain(plain_spec, plain_recording);
    const auto differences = BuildProblem(plain, Noise{1.0, 1.0});
    const MatrixXd raw = Rows(differences.get(), state);
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
    const auto without = BuildProblem(calibration, Noise{0.3, 1.0}, /*with_loss=*/false);
    const VectorXd r = Rows(without.get(), scenario->truth * 0.3).rightCols(1);
    double expected = 0;
    bool beyond = false, within = false;
    for (Eigen::Index block = 0; block < r.size(); block += 3) {
      const double square = r.segment<3>(block).squaredNorm();
      (square > 0.04 ? beyond : within) = true;
      expected += 0.5 * Rho(loss, 0.2, square);
    }
    ASSERT_TRUE(beyond && within) << "the loss must bend some blocks and not others";
    for (std::size_t k = 0; k < 6; ++k) expected += 0.5 * std::pow(without->state[k] / 1e-3, 2);

    const auto with = BuildProblem(calibration, Noise{0.3, 1.0});
    with->set_state(scenario->truth * 0.3);
    double cost = std::numeric_limits<double>::quiet_NaN();
    ASSERT_TRUE(with->problem->Evaluate({}, &cost, nullptr, nullptr, nullptr));
    EXPECT_NEAR(cost, expected, 1e-12 * expected);
  }
}

TEST(Priors, PullCorrectionsToZeroAndSetTheirScale) {
  ScenarioOptions options;
  options.robot = Kr15();
  options.estimate = {"theta", "a"};
  const auto scenario = MakeScenario(options);
  scenario->spec.parameters.prior_sigma = {{"a", 2e-4}, {"a2", 1e-4}, {"theta3", 1e-3}};
  const Calibration calibration(scenario->spec, scenario->recording);
  const auto problem = BuildProblem(calibration, Noise{});
  ASSERT_EQ(problem->priors.size(), 7u);
  problem->set_state(VectorXd::Constant(12, 1e-3));
  VectorXd r;
  MatrixXd J;
  ASSERT_TRUE(ForEachChunk(problem.get(),
                           problem->priors,
                           [&](int /*first*/, const VectorXd& values, const MatrixXd& rows) {
                             r = values;
                             J = rows;
                           }));
  // theta3, then a1 to a6.
  VectorXd expected(7);
  expected << 1, 5, 10, 5, 5, 5, 5;
  EXPECT_THAT(r, MatrixNear(expected, 1e-13));
  MatrixXd slopes = MatrixXd::Zero(7, 12);
  slopes(0, 2) = 1e3;
  for (int k = 0; k < 6; ++k) slopes(1 + k, 6 + k) = k == 1 ? 1e4 : 5e3;
  EXPECT_THAT(J, MatrixNear(slopes, 1e-10));
  EXPECT_EQ(problem->scales.tolerance[7], 1e-4);
}

TEST(BuildProblem, TakesTargetsByNameWhicheverTheRecordingHasFirst) {
  ScenarioOptions options;
  options.robot = Kr15();
  options.targets = true;
  options.recorded_targets = {"B", "A"};
  const auto scenario = MakeScenario(options);
  const auto problem = BuildProblem(*scenario->calibration, Noise{});
  const VectorXd r = Rows(problem.get(), scenario->truth).rightCols(1);
  EXPECT_THAT(r, MatrixNear(VectorXd::Zero(36), 1e-13));
}

TEST(BuildProblem, LeavesOutTestRowsAndBlankRows) {
  ScenarioOptions options;
  options.robot = Kr15();
  const auto scenario = MakeScenario(options);
  const auto all = BuildProblem(*scenario->calibration, Noise{});
  scenario->recording.is_test.assign(12, false);
  scenario->recording.is_test[4] = true;
  scenario->recording.p_WQ(7, 1) = std::numeric_limits<double>::quiet_NaN();
  const Calibration calibration(scenario->spec, scenario->recording);
  const auto fewer = BuildProblem(calibration, Noise{});
  const VectorXd state = VectorXd::Zero(scenario->truth.size());
  const MatrixXd before = Rows(all.get(), state), after = Rows(fewer.get(), state);
  ASSERT_EQ(after.rows(), 30);
  EXPECT_THAT(after.topRows(12), MatrixNear(before.topRows(12), 0));
  EXPECT_THAT(after.middleRows(12, 6), MatrixNear(before.middleRows(15, 6), 0));
  EXPECT_THAT(after.bottomRows(12), MatrixNear(before.bottomRows(12), 0));
}

}  // namespace
}  // namespace dhcal
