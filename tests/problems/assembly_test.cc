// Laws of every problem that BuildProblem makes, for all measurement kinds and ways in which bases,
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
  add("position", Kr15(), MeasurementKind::kPosition);
  add("position_sliding", Scara(), MeasurementKind::kPosition)->row_sigmas = true;
  add("position_targets", Ur10(), MeasurementKind::kPosition)->targets = true;
  ScenarioOptions* per_run = add("position_base_per_run", Kr15(), MeasurementKind::kPosition);
  per_run->two_runs = per_run->base_per_run = per_run->row_sigmas = true;
  ScenarioOptions* both = add("position_base_per_run_targets", Kr15(), MeasurementKind::kPosition);
  both->two_runs = both->base_per_run = both->targets = true;
  add("pose", Panda(), MeasurementKind::kPose)->estimate = {"complete", "beta"};
  ScenarioOptions* tools = add("pose_tool_per_run", Kr15Modified(), MeasurementKind::kPose);
  tools->two_runs = tools->tool_per_run = tools->row_sigmas = true;
  add("pose_targets_sliding", ScaraModified(), MeasurementKind::kPose)->targets = true;
  add("distance", Kr15(), MeasurementKind::kDistance)->row_sigmas = true;
  ScenarioOptions* wires = add("distance_per_run", Ur10(), MeasurementKind::kDistance);
  wires->two_runs = wires->base_per_run = wires->tool_per_run = true;
  add("adjacent", Scara(), MeasurementKind::kAdjacentPosition)->row_sigmas = true;
  ScenarioOptions* pairs = add("adjacent_runs_targets", Ur10(), MeasurementKind::kAdjacentPosition);
  pairs->two_runs = pairs->base_per_run = pairs->targets = true;
  pairs->num_rows = 18;
  add("adjacent_displacements", Kr15(), MeasurementKind::kAdjacentPosition)->displacements = true;
  add("shared_pose", Kr15(), MeasurementKind::kAdjacentPosition)->shared_pose = true;
  ScenarioOptions* shared = add("shared_pose_all", Scara(), MeasurementKind::kAdjacentPosition);
  *shared = *pairs;
  shared->name = "shared_pose_runs_targets";
  shared->shared_pose = shared->row_sigmas = true;
  ScenarioOptions* steps = add("shared_displacements", Ur10(), MeasurementKind::kAdjacentPosition);
  steps->shared_pose = steps->displacements = true;
  return all;
}

class BuildProblemLaws : public testing::TestWithParam<ScenarioOptions> {
 protected:
  BuildProblemLaws()
      : scenario_(MakeScenario(GetParam())),
        problem_(BuildProblem(*scenario_->calibration, kLargeNoise)) {}

  VectorXd Residuals(const VectorXd& state) {
    problem_->set_state(state);
    std::vector<double> r;
    EXPECT_TRUE(problem_->problem->Evaluate(Options(), nullptr, &r, nullptr, nullptr));
    return Eigen::Map<VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()));
  }

  MatrixXd Jacobian(const VectorXd& state) {
    problem_->set_state(state);
    ceres::CRSMatrix sparse;
    EXPECT_TRUE(problem_->problem->Evaluate(Options(), nullptr, nullptr, nullptr, &sparse));
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

  ceres::Problem::EvaluateOptions Options() {
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = problem_->blocks();
    options.residual_blocks = problem_->readings;
    return options;
  }

  std::unique_ptr<AssemblyScenario> scenario_;
  std::unique_ptr<EstimationProblem> problem_;
};

TEST_P(BuildProblemLaws, StartsAtZeroWithOneBlockPerReading) {
  EXPECT_EQ(problem_->state_vector(), VectorXd::Zero(scenario_->truth.size()));
  EXPECT_EQ(problem_->readings.size(), scenario_->calibration->readings.fitted.size());
  EXPECT_GE(problem_->readings.size(), 8u);
  EXPECT_TRUE(problem_->priors.empty());
}

TEST_P(BuildProblemLaws, ResidualsVanishAtTheTruth) {
  const VectorXd r = Residuals(scenario_->truth);
  // Positions agree to 1e-14 m, a few over their sigmas and, of displacements, summed up.
  EXPECT_THAT(r, MatrixNear(VectorXd::Zero(r.size()), 1e-13));
}

TEST_P(BuildProblemLaws, ResidualsAreIndependentPredictionMinusReadingOverSigma) {
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
    if (GetParam().kind == MeasurementKind::kDistance) {
      const Vector3d anchor = row % 3 == 0 ? Vector3d(-3, 2, 4) : Vector3d(2.5, 1, 0);
      const double predicted = (point(state, row) - anchor).norm();
      const double measured = (point(scenario_->truth, row) - anchor).norm();
      EXPECT_NEAR(r[at], (predicted - measured) / sigma, 1e-12);
      at += 1;
      continue;
    }
    if (GetParam().kind == MeasurementKind::kAdjacentPosition) {
      moved -= point(state, reading.previous_idx) - point(scenario_->truth, reading.previous_idx);
    }
    EXPECT_THAT(r.segment<3>(at), MatrixNear(moved / sigma, 1e-12));
    at += 3;
    if (GetParam().kind != MeasurementKind::kPose) continue;
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

TEST_P(BuildProblemLaws, JacobianEqualsRiddersDifferencesOfItsResiduals) {
  const auto residuals = [this](const VectorXd& x) { return Residuals(x); };
  for (const VectorXd& state : {RandomState(0, 1), RandomState(1e-8, 2), RandomState(0.1, 3)}) {
    const MatrixXd J = Jacobian(state);
    // Ridders' own error, about 1e-11 of functions of this size.
    const double scale = std::max(1.0, J.lpNorm<Eigen::Infinity>());
    EXPECT_THAT(J, MatrixNear(RiddersJacobian(residuals, state), 1e-9 * scale));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios,
                         BuildProblemLaws,
                         testing::ValuesIn(Scenarios()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace dhcal
