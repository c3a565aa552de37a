// The figures of problems/guides/planning.md: what plans are worth, measured on robots whose truth
// is calculated elsewhere. Prints them.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "problems/formats/recording/recording_reader.h"
#include "problems/identify.h"
#include "problems/plan/plan.h"
#include "problems/task/points.h"
#include "problems/task/region.h"
#include "tests/support/edge_head.h"
#include "tests/support/problem_cases.h"
#include "tests/support/recorder.h"

namespace dhcal {
namespace {

constexpr int kTruthPoses = 2000;

double RmsOfPoints(const Eigen::VectorXd& coordinates) {
  return std::sqrt(3 * coordinates.squaredNorm() / static_cast<double>(coordinates.size()));
}

double QuantileOfDraws(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

Eigen::MatrixXd WidePoses(const RobotModel& robot, int count, std::uint64_t seed) {
  Rng rng(seed);
  const JointRange range(robot);
  Eigen::MatrixXd q(count, robot.num_joints());
  for (Eigen::Index row = 0; row < q.rows(); ++row) q.row(row) = range.Draw(&rng).transpose();
  return q;
}

/// Points of the true robot.
Eigen::Matrix3Xd PointsOfTruth(const TrueRobot& truth, const Eigen::MatrixXd& q) {
  Eigen::Matrix3Xd points(3, q.rows());
  for (Eigen::Index row = 0; row < q.rows(); ++row) {
    points.col(row) = truth.Pose(q.row(row).transpose()).block<3, 1>(0, 3);
  }
  return points;
}

Eigen::Matrix3Xd PointsOf(const RobotModel& robot, const Eigen::MatrixXd& q) {
  const DhChain chain(robot);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(chain.slots().size());
  Eigen::Matrix3Xd points(3, q.rows());
  for (Eigen::Index row = 0; row < q.rows(); ++row) {
    points.col(row) =
        chain.Pose<double>(q.row(row).transpose(), none, {robot.X_WB, robot.X_TQ}).translation();
  }
  return points;
}

/// RMS [m] at new poses of a calibration with readings of the true robot at `q`; `expected`: what
/// its own covariance says of them.
double RealisedError(const ProblemSpec& spec,
                     const TrueRobot& truth,
                     const Eigen::MatrixXd& q,
                     const Eigen::MatrixXd& q_new,
                     std::uint64_t seed,
                     double* expected = nullptr) {
  Rng rng(seed);
  Recording rows;
  rows.q = q;
  rows.p_WQ = PointsOfTruth(truth, q).transpose();
  for (double& coordinate : rows.p_WQ.reshaped()) {
    coordinate += *spec.measurement.sigma * rng.Normal();
  }
  const Result result = IdentifyGeometry(spec, rows, {});
  if (result.best() == nullptr) return HUGE_VAL;
  if (expected != nullptr) *expected = result.task->after.rms;
  const Eigen::Matrix3Xd errors = PointsOf(result.calibrated, q_new) - PointsOfTruth(truth, q_new);
  return RmsOfPoints(errors.reshaped());
}

TEST(SlowPlanFigures, HundredFreePosesOfTheKr15) {
  ProblemSpec spec = LoadCase("kr15_planned");
  const Recording own = RecordingOf(spec);
  TrueRobot truth;
  truth.nominal = spec.robot;
  truth.delta = Eigen::VectorXd::Zero(42);
  for (const JointNumber& number : kJointNumbers) {
    const Eigen::VectorXd& errors = spec.simulate->row_errors(number.slot);
    for (int joint = 0; joint < errors.size(); ++joint) {
      truth.delta[SlotLayout(6).joint(joint, number.slot)] = errors[joint];
    }
  }
  spec.simulate.reset();
  spec.task.reset();  // the whole range
  Diagnostics diagnostics;
  const auto plan = PlanPoses(spec, nullptr, {}, &diagnostics);
  ASSERT_TRUE(plan.has_value()) << diagnostics.ToString();
  const Eigen::MatrixXd q_new = WidePoses(spec.robot, kTruthPoses, 999);
  spec.task.emplace();
  spec.task->q = q_new;
  constexpr int kDraws = 40;
  std::vector<double> planned, random, paper;
  int better = 0, expected_better = 0;
  for (std::uint64_t draw = 1; draw <= kDraws; ++draw) {
    double expected = 0, expected_of_random = 0;
    planned.push_back(RealisedError(spec, truth, plan->rows.q, q_new, draw, &expected));
    const Eigen::MatrixXd wide = WidePoses(spec.robot, 100, 5000 + draw);
    random.push_back(RealisedError(spec, truth, wide, q_new, 100 + draw, &expected_of_random));
    expected_better += expected < expected_of_random ? 1 : 0;
    paper.push_back(RealisedError(spec, truth, own.q, q_new, 200 + draw));
    better += planned.back() < random.back() ? 1 : 0;
  }
  for (const auto& [name, rms] : {std::pair("planned", planned),
                                  std::pair("random wide", random),
                                  std::pair("the paper's", paper)}) {
    std::cout << fmt::format("{:12} median {:6.2f} um, 95 % below {:6.2f} um, largest {:6.2f} um\n",
                             name,
                             QuantileOfDraws(rms, 0.5) / kMicrometre,
                             QuantileOfDraws(rms, 0.95) / kMicrometre,
                             QuantileOfDraws(rms, 1) / kMicrometre);
  }
  std::cout << fmt::format(
      "planned below random in {} of {} draws, by the errors expected in {} of {}\n",
      better,
      kDraws,
      expected_better,
      kDraws);
  EXPECT_GE(expected_better, 38);
  EXPECT_LT(QuantileOfDraws(planned, 0.5), 5e-6);
  EXPECT_GT(QuantileOfDraws(paper, 0.5), 10 * QuantileOfDraws(planned, 0.5));
}

/// What a shift of the head along its sights does, [m] per metre: no reading over an edge shows it
/// (residuals/kinds/straight_edge.md).
Eigen::VectorXd ShiftAlongSights(const RobotModel& robot, const Eigen::MatrixXd& q) {
  RobotModel shifted = robot;
  shifted.X_TQ.translation() += shifted.X_TQ.linear().col(2);
  const Eigen::Matrix3Xd points = PointsOf(robot, q);
  const Eigen::Matrix3Xd moves = PointsOf(shifted, q) - points;
  return WithoutMotion(points, moves.reshaped());
}

/// RMS [m] in a region, moved as a whole to fit best and beside what no reading shows, of a
/// calibration with a head over edges.
double RealisedOverEdges(const ProblemSpec& spec,
                         const std::vector<Edge>& edges,
                         const Recording& rows,
                         const Eigen::MatrixXd& q_new,
                         std::uint64_t seed) {
  ProblemSpec placed = spec;
  placed.robot.edges = placed.measurement.edges = edges;
  const independent::HeadTruth truth = independent::MakeHeadTruth(placed, seed);
  const Recording recording =
      independent::RecordHead(placed, truth, rows, *placed.measurement.sigma, seed);
  const Result result = IdentifyGeometry(placed, recording, {});
  if (result.best() == nullptr) return HUGE_VAL;
  RobotModel in_base = result.calibrated, nominal = spec.robot;
  in_base.X_WB = nominal.X_WB = Eigen::Isometry3d::Identity();
  const TrueRobot arm{nominal, truth.delta, Eigen::Isometry3d::Identity()};
  const Eigen::Matrix3Xd true_points = PointsOfTruth(arm, q_new);
  const Eigen::Matrix3Xd errors = PointsOf(in_base, q_new) - true_points;
  const Eigen::VectorXd aligned = WithoutMotion(true_points, errors.reshaped());
  const Eigen::VectorXd hidden = ShiftAlongSights(nominal, q_new);
  return RmsOfPoints(aligned - hidden * (hidden.dot(aligned) / hidden.squaredNorm()));
}

TEST(SlowPlanFigures, TwelvePlacementsOfTwentyPoses) {
  ProblemSpec spec = LoadCase("kr15_edges");
  const RobotModel limited = LoadCase("kr15_planned").robot;
  for (std::size_t k = 0; k < 6; ++k) {
    spec.robot.joints[k].lower = limited.joints[k].lower;
    spec.robot.joints[k].upper = limited.joints[k].upper;
  }
  spec.simulate.reset();
  spec.task.emplace();
  spec.task->box = TaskBox{{0.8, -0.4, 0.3}, {1.3, 0.4, 1.1}};
  PlanOptions options;
  options.criterion = DesignCriterion::kI;
  options.candidates = 600;
  options.volume = TaskBox{{0.3, -1.1, 0.0}, {1.6, 1.1, 1.4}};
  Diagnostics diagnostics;
  const auto plan = PlanPoses(spec, nullptr, options, &diagnostics);
  ASSERT_TRUE(plan.has_value()) << diagnostics.ToString();
  const Eigen::MatrixXd q_new = DrawInBox(spec.robot, *spec.task->box, 300, 77);
  constexpr int kDraws = 20;
  std::vector<double> planned, random;
  for (std::uint64_t draw = 1; draw <= kDraws; ++draw) {
    planned.push_back(RealisedOverEdges(spec, plan->edges, plan->rows, q_new, draw));
    Rng rng(3000 + draw);
    const Candidates wild = DrawEdges(spec.robot, options.volume, options.edge, 12, &rng);
    random.push_back(RealisedOverEdges(spec, wild.edges, wild.rows, q_new, draw));
  }
  for (const PlannedError& error : plan->errors) {
    std::cout << fmt::format("{:3} placements: predicted {:6.1f} um, random {:6.1f} um\n",
                             error.count,
                             error.rms / kMicrometre,
                             error.rms_random / kMicrometre);
  }
  std::cout << fmt::format("realised: planned median {:.1f} um, random median {:.1f} um\n",
                           QuantileOfDraws(planned, 0.5) / kMicrometre,
                           QuantileOfDraws(random, 0.5) / kMicrometre);
  EXPECT_LT(2 * QuantileOfDraws(planned, 0.5), QuantileOfDraws(random, 0.5));
}

}  // namespace
}  // namespace dhcal
