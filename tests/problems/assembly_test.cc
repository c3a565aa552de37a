// Laws of every CalibrationProblem, for all measurement kinds and ways in which bases,
// tools, targets, runs and sigmas differ between rows.
#include "problems/assembly.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <ceres/crs_matrix.h>
#include <gtest/gtest.h>

#include "core/solver/linearization.h"
#include "residuals/registry.h"
#include "residuals/row_cache.h"
#include "tests/problems/assembly_scenario.h"
#include "tests/support/matchers.h"
#include "tests/support/ridders.h"

namespace dhcal {

std::ostream& operator<<(std::ostream& os, const ScenarioOptions& options) {
  return os << options.name;
}

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Noise kLargeNoise{0.5, 0.7};  // large: residuals of the size of the robot

std::vector<ScenarioOptions> Scenarios() {
  std::vector<ScenarioOptions> all;
  all.reserve(20);  // pointers into it are kept
  const auto add = [&all](const std::string& name, const RobotModel& robot, MeasurementKind kind) {
    all.emplace_back();
    all.back().name = name;
    all.back().robot = robot;
    all.back().kind = kind;
    return &all.back();
  };
  add("position", Kr15(), KindNamed("position"));
  add("position_sliding", Scara(), KindNamed("position"))->row_sigmas = true;
  add("position_targets", Ur10(), KindNamed("position"))->targets = true;
  ScenarioOptions* per_run = add("position_base_per_run", Kr15(), KindNamed("position"));
  per_run->two_runs = per_run->base_per_run = per_run->row_sigmas = true;
  ScenarioOptions* both = add("position_base_per_run_targets", Kr15(), KindNamed("position"));
  both->two_runs = both->base_per_run = both->targets = true;
  add("pose", Panda(), KindNamed("pose"))->estimate = {"complete", "beta"};
  ScenarioOptions* tools = add("pose_tool_per_run", Kr15Modified(), KindNamed("pose"));
  tools->two_runs = tools->tool_per_run = tools->row_sigmas = true;
  add("pose_targets_sliding", ScaraModified(), KindNamed("pose"))->targets = true;
  add("distance", Kr15(), KindNamed("distance"))->row_sigmas = true;
  ScenarioOptions* wires = add("distance_per_run", Ur10(), KindNamed("distance"));
  wires->two_runs = wires->base_per_run = wires->tool_per_run = true;
  add("adjacent", Scara(), KindNamed("adjacent_position"))->row_sigmas = true;
  ScenarioOptions* pairs = add("adjacent_runs_targets", Ur10(), KindNamed("adjacent_position"));
  pairs->two_runs = pairs->base_per_run = pairs->targets = true;
  pairs->num_rows = 18;
  add("adjacent_displacements", Kr15(), KindNamed("adjacent_position"))->displacements = true;
  add("shared_pose", Kr15(), KindNamed("adjacent_position"))->shared_pose = true;
  ScenarioOptions* shared = add("shared_pose_all", Scara(), KindNamed("adjacent_position"));
  *shared = *pairs;
  shared->name = "shared_pose_runs_targets";
  shared->shared_pose = shared->row_sigmas = true;
  ScenarioOptions* steps = add("shared_displacements", Ur10(), KindNamed("adjacent_position"));
  steps->shared_pose = steps->displacements = true;
  return all;
}

class CalibrationProblemLaws : public testing::TestWithParam<ScenarioOptions> {
 protected:
  CalibrationProblemLaws()
      : scenario_(MakeScenario(GetParam())),
        problem_(std::make_unique<CalibrationProblem>(*scenario_->calibration, kLargeNoise)) {}

  VectorXd Residuals(const VectorXd& state) {
    problem_->set_state(state);
    std::vector<double> r;
    EXPECT_TRUE(problem_->problem()->Evaluate({}, nullptr, &r, nullptr, nullptr));
    return Eigen::Map<VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()));
  }

  MatrixXd Jacobian(const VectorXd& state) {
    problem_->set_state(state);
    ceres::CRSMatrix sparse;
    EXPECT_TRUE(problem_->problem()->Evaluate({}, nullptr, nullptr, nullptr, &sparse));
    MatrixXd J = MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
    for (int row = 0; row < sparse.num_rows; ++row) {
      for (int k = sparse.rows[static_cast<std::size_t>(row)];
           k < sparse.rows[static_cast<std::size_t>(row) + 1];
           ++k) {
        J(row, sparse.cols[static_cast<std::size_t>(k)]) =
            sparse.values[static_cast<std::size_t>(k)];
      }
    }
    return J;
  }

  VectorXd RandomState(double size, std::uint64_t seed) const {
    Rng rng(seed);
    VectorXd state(scenario_->truth.size());
    for (double& value : state) value = rng.Uniform(-size, size);
    return state;
  }

  std::unique_ptr<AssemblyScenario> scenario_;
  std::unique_ptr<CalibrationProblem> problem_;
};

TEST_P(CalibrationProblemLaws, StartsAtZeroWithOneBlockPerReading) {
  EXPECT_EQ(problem_->state(), VectorXd::Zero(scenario_->truth.size()));
  EXPECT_EQ(problem_->readings().size(), scenario_->calibration->readings.fitted.size());
  EXPECT_GE(problem_->readings().size(), 8u);
  EXPECT_TRUE(problem_->priors().empty());
}

TEST_P(CalibrationProblemLaws, ResidualsVanishAtTheTruth) {
  const VectorXd r = Residuals(scenario_->truth);
  // Positions agree to 1e-14 m, a few over their sigmas and, of displacements, summed up.
  EXPECT_THAT(r, MatrixNear(VectorXd::Zero(r.size()), 1e-13));
}

TEST_P(CalibrationProblemLaws, ResidualsAreIndependentPredictionMinusReadingOverSigma) {
  if (GetParam().shared_pose) GTEST_SKIP() << "whitened contrasts: assembly_rules_test.cc";
  const VectorXd state = RandomState(0.05, 1);
  const VectorXd r = Residuals(state);
  const Recording& recording = scenario_->recording;
  Eigen::Index at = 0;
  for (const Reading& reading : scenario_->calibration->readings.fitted) {
    SCOPED_TRACE(testing::Message() << "row " << reading.row_idx);
    const int row = reading.row_idx;
    const bool own = recording.sigma.size() > 0 && !std::isnan(recording.sigma[row]);
    const double sigma = own ? recording.sigma[row] : kLargeNoise.sigma;
    const auto point = [&](const VectorXd& x, int row_idx) -> Vector3d {
      return scenario_->IndependentPose(x, row_idx).topRightCorner<3, 1>();
    };
    Vector3d moved = point(state, row) - point(scenario_->truth, row);
    if (GetParam().kind.name == "distance") {
      const Vector3d anchor = row % 3 == 0 ? Vector3d(-3, 2, 4) : Vector3d(2.5, 1, 0);
      const double predicted = (point(state, row) - anchor).norm();
      const double measured = (point(scenario_->truth, row) - anchor).norm();
      EXPECT_NEAR(r[at], (predicted - measured) / sigma, 1e-12);
      at += 1;
      continue;
    }
    if (GetParam().kind.name == "adjacent_position") {
      moved -= point(state, reading.previous_idx) - point(scenario_->truth, reading.previous_idx);
    }
    EXPECT_THAT(r.segment<3>(at), MatrixNear(moved / sigma, 1e-12));
    at += 3;
    if (GetParam().kind.name != "pose") continue;
    // Exp of the rotation rows leads from the measured orientation to the predicted one.
    const Vector3d turn = kLargeNoise.sigma_rotation * r.segment<3>(at);
    const auto orientation = [&](const VectorXd& x) -> Eigen::Matrix3d {
      return scenario_->IndependentPose(x, row).topLeftCorner(3, 3);
    };
    EXPECT_THAT(independent::RotationOf<double>(turn.x(), turn.y(), turn.z()) *
                    orientation(scenario_->truth),
                MatrixNear(orientation(state), 1e-12));
    at += 3;
  }
  EXPECT_EQ(at, r.size());
}

TEST_P(CalibrationProblemLaws, JacobianEqualsRiddersDifferencesOfItsResiduals) {
  const auto residuals = [this](const VectorXd& x) { return Residuals(x); };
  for (const VectorXd& state : {RandomState(0, 1), RandomState(1e-8, 2), RandomState(0.1, 3)}) {
    const MatrixXd J = Jacobian(state);
    // Ridders' own error, about 1e-11 of functions of this size.
    const double scale = std::max(1.0, J.lpNorm<Eigen::Infinity>());
    EXPECT_THAT(J, MatrixNear(RiddersJacobian(residuals, state), 1e-9 * scale));
  }
}

TEST_P(CalibrationProblemLaws, BlocksOfStretchesHaveTheSquaresGradientAndCurvatureOfTheReadings) {
  const VectorXd state = RandomState(0.05, 4);
  const MatrixXd J = Jacobian(state);
  const VectorXd r = Residuals(state);
  RowCache stretches(&problem_->rows(), problem_->row_noise(), BlockSize::kStretch);
  ASSERT_TRUE(stretches.MoveTo(state));
  MatrixXd products = MatrixXd::Zero(J.cols() + 1, J.cols() + 1);
  for (int block = 0; block < stretches.num_blocks(); ++block) {
    const MatrixXd rows = stretches.block(block);
    EXPECT_LE(rows.rows(), J.cols() + 1);
    products += rows.transpose() * rows;
  }
  MatrixXd rows(J.rows(), J.cols() + 1);
  rows << J, r;
  const MatrixXd expected = rows.transpose() * rows;
  EXPECT_THAT(products, MatrixNear(expected, 1e-12 * expected.lpNorm<Eigen::Infinity>()));
}

TEST_P(CalibrationProblemLaws, EachStateIsEvaluatedOnceWhoeverAsks) {
  const VectorXd state = RandomState(0.05, 5);
  const int before = problem_->cache().num_evaluations();
  Residuals(state);
  Jacobian(state);
  Linearization linearization;
  ASSERT_TRUE(Linearize(problem_.get(), &linearization));
  EXPECT_EQ(problem_->cache().num_evaluations(), before + 1);
}

INSTANTIATE_TEST_SUITE_P(Scenarios,
                         CalibrationProblemLaws,
                         testing::ValuesIn(Scenarios()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace dhcal
