// The measuring head over straight edges: what its readings determine, and whether the answers and
// their intervals are right. Truth: tests/support/edge_head.h.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/physics/columns.h"
#include "core/physics/registry.h"
#include "problems/fit_analysis.h"
#include "problems/formats/result/result_writer.h"
#include "problems/identify.h"
#include "problems/noise.h"
#include "problems/start.h"
#include "residuals/registry.h"
#include "tests/support/edge_head.h"
#include "tests/support/problem_cases.h"
#include "tests/support/robots.h"
#include "tests/support/same_rows.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kCameraNoise = 20e-6;  // [m], of the case
constexpr int kPlacements = 12;
// 4 per turning axis: the line of each of six axes and the head's pose on the last link, less where
// the robot stands (residuals/kinds/straight_edge.md).
constexpr int kArmAndHead = 4 * 6;

/// The shipped case's rows without readings.
Recording RowsOfCase(const ProblemSpec& spec) {
  Recording rows = RecordingOf(spec);
  rows.head.resize(0, 0);
  return rows;
}

/// The case with edges that are named and stand anywhere.
ProblemSpec Unplaced(ProblemSpec spec) {
  for (Edge& edge : spec.robot.edges) edge.X_WE.reset();
  return spec;
}

int RankOf(const Eigen::MatrixXd& J) {
  const Eigen::VectorXd s = Eigen::BDCSVD<Eigen::MatrixXd>(J).singularValues();
  return static_cast<int>((s.array() > 1e-9 * s[0]).count());
}

TEST(StraightEdge, TheSimulatorReadsWhatTheIndependentHeadReads) {
  ProblemSpec spec = LoadCase("kr15_edges");
  spec.simulate->noise = 0;
  const Recording recording = RecordingOf(spec);
  independent::HeadTruth truth;
  truth.delta = Eigen::VectorXd::Zero(42);
  const double theta[] = {870e-6, 940e-6, -1000e-6, 620e-6, -810e-6, 260e-6};
  const double alpha[] = {157e-6, 130e-6, -160e-6, -253e-6, 462e-6, -320e-6};
  const double a[] = {31e-6, 51e-6, 12e-6, -45e-6, 64e-6, 58e-6};
  const double d[] = {-75e-6, 31e-6, 22e-6, 48e-6, -20e-6, 78e-6};
  for (int k = 0; k < 6; ++k) truth.delta.segment<4>(5 * k) << theta[k], d[k], a[k], alpha[k];
  truth.delta.tail<6>() << 1.5e-3, -0.8e-3, 0.6e-3, 4e-3, -3e-3, 6e-3;
  for (const Edge& edge : spec.robot.edges) truth.edges[edge.name] = *edge.X_WE;
  ASSERT_EQ(recording.num_rows(), 240);
  for (int row = 0; row < recording.num_rows(); ++row) {
    const Vector3d numbers = independent::NumbersOfRow(spec, truth, recording, row);
    EXPECT_LT((recording.head.row(row).transpose() - numbers).norm(), 1e-12) << row;
    EXPECT_NEAR(numbers[1], 0.05, 0.06) << "the head is not over the edge in row " << row;
  }
}

TEST(StraightEdge, DerivativesByRowsAndToolEqualTheIndependentOnes) {
  const ProblemSpec spec = LoadCase("kr15_edges");
  const Recording rows = RecordingOf(spec);
  independent::HeadTruth nominal;
  nominal.delta = Eigen::VectorXd::Zero(42);
  for (const Edge& edge : spec.robot.edges) nominal.edges[edge.name] = *edge.X_WE;
  const Eigen::MatrixXd expected = independent::HeadJacobian(spec, nominal, rows);

  const Calibration c(spec, rows);
  ASSERT_EQ(3 * c.readings.fitted.size(), static_cast<std::size_t>(expected.rows()));
  RowNoise unit;
  unit.sigma = Eigen::VectorXd::Ones(rows.num_rows());
  const auto& coordinates = spec.measurement.kind.coordinates;
  Eigen::MatrixXd J(expected.rows(), static_cast<Eigen::Index>(c.parameters.size()));
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(J.cols());
  ASSERT_TRUE(RowsOf(c, c.readings.fitted).Visit(zero, unit, [&](const TileRows& tile) {
    const auto count = static_cast<Eigen::Index>(tile.readings.size());
    for (Eigen::Index k = 0; k < tile.r().size(); ++k) {
      const Eigen::Index coordinate = k / count;
      const Eigen::Index row = 3 * tile.readings[static_cast<std::size_t>(k % count)] + coordinate;
      J.row(row) = coordinates[static_cast<std::size_t>(coordinate)].noise * tile.J().row(k);
    }
  }));
  // Columns there: theta, d, a, alpha of each joint (of joint 2 beta, too), then the tool.
  Eigen::Index column = 0;
  const SlotLayout slots(6);
  const auto expect_column = [&](int slot, double unit_of_column) {
    for (std::size_t k = 0; k < c.parameters.size(); ++k) {
      if (c.parameters[k].slot != slot) continue;
      const Eigen::VectorXd own = unit_of_column * J.col(static_cast<Eigen::Index>(k));
      EXPECT_LT((own - expected.col(column)).norm(), 1e-12) << c.parameters[k].name;
    }
    ++column;
  };
  for (int slot = 0; slot < slots.base(0); ++slot) {
    const JointSlot number = SlotLayout::NumberAt(slot);
    if (number == JointSlot::kBeta && SlotLayout::JointOf(slot) != 1) continue;
    const bool length = number == JointSlot::kD || number == JointSlot::kA;
    expect_column(slot, number == JointSlot::kTheta ? 3e-3 : length ? 5e-4 : 1e-3);
  }
  for (int slot = slots.tool(0); slot < slots.size(); ++slot) expect_column(slot, 5e-3);
}

TEST(StraightEdge, RowsOfTheDiagnosisAreThoseOfTheResidualBlocks) {
  const ProblemSpec spec = LoadCase("kr15_edges");
  const Recording recording = RecordingOf(spec);
  const Calibration c(spec, recording);
  ExpectRowsOfTheResidualBlocks(c, {kCameraNoise, 1});
}

TEST(StraightEdge, CalibratedEdgesReadBack) {
  const TempFolder folder;
  const ProblemSpec spec = LoadCase("kr15_edges");
  RobotModel robot = spec.robot;
  Rng rng(5);
  for (Edge& edge : robot.edges) {
    const Vector3d p(rng.Normal(), rng.Normal(), rng.Normal());
    edge.X_WE = MakeFrame(p, 0.3 * p) * *edge.X_WE;
  }
  WriteFile(folder / "calibrated.yaml", CalibratedYaml(spec, robot, {}, "rows.csv"));
  const ProblemSpec read = LoadProblem(folder / "calibrated.yaml");
  ASSERT_EQ(read.robot.edges.size(), robot.edges.size());
  for (std::size_t k = 0; k < robot.edges.size(); ++k) {
    EXPECT_EQ(read.robot.edges[k].name, robot.edges[k].name);
    EXPECT_EQ(read.robot.edges[k].X_WE->translation(), robot.edges[k].X_WE->translation());
    EXPECT_LT((read.robot.edges[k].X_WE->linear() - robot.edges[k].X_WE->linear()).norm(), 1e-14);
  }
  EXPECT_DOUBLE_EQ(read.measurement.kind.coordinates[1].noise, 0.5);
}

TEST(StraightEdge, LeftOutPhysicsHasItsName) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  ProblemSpec spec = LoadCase("kr15_edges");
  spec.robot.links.resize(6);
  spec.robot.links[1] = {40, Vector3d(-0.3, 0, 0.1)};
  spec.robot.links[3] = {25, Vector3d(0, 0, -0.2)};
  spec.robot.payload = {8, Vector3d(0, 0, 0.1)};
  EffectRequest compliance;
  compliance.effect = "joint_compliance";
  compliance.joint = 2;
  compliance.values = {{"compliance", 8e-6}};
  spec.simulate->effects = {compliance};
  const DiagnosisResult diagnosis = Diagnosed(spec, RecordingOf(spec));
  EXPECT_EQ(diagnosis.verdict, DiagnosisVerdict::kExplained) << diagnosis.summary;
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  EXPECT_EQ(diagnosis.findings[0].effect.effect, "joint_compliance");
  EXPECT_EQ(diagnosis.findings[0].effect.joint, 2);
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value / 8e-6, 1, 0.05);
}

TEST(StraightEdge, NothingMovesTheBaseInAFrameThatEdgesDoNotShare) {
  const ProblemSpec spec = LoadCase("kr15_edges");
  Recording recording = RecordingOf(spec);
  recording.time = Eigen::VectorXd::LinSpaced(recording.num_rows(), 0, 3600);
  const Calibration c(spec, recording);
  for (const char* const name : {"base_drift", "base_step", "base_per_run"}) {
    EffectRequest request;
    request.effect = name;
    request.settings = {{"time_constant_s", 0}, {"at_s", 1800}};
    EXPECT_EQ(FindEffect(name)->NotTestable(c.Context(), request), kFrameOfEdges) << name;
  }
}

TEST(StraightEdge, RankIsTheDerivedOne) {
  ProblemSpec spec = LoadCase("kr15_edges");
  const Recording rows = RowsOfCase(spec);
  const auto truth = independent::MakeHeadTruth(spec, 3);
  // Of each placement, x and y are hidden; all sights are parallel, so a shift of the head along
  // them is, too.
  constexpr int kDerived = kArmAndHead - 1 + 4 * kPlacements;
  EXPECT_EQ(RankOf(independent::HeadJacobian(spec, truth, rows)), kDerived);
  const Result result =
      IdentifyGeometry(spec, RecordHead(spec, truth, rows, kCameraNoise, 1), Progress());
  ASSERT_NE(result.best(), nullptr);
  EXPECT_EQ(result.best()->rank_numerical, kDerived);
  EXPECT_EQ(result.best()->rank, kDerived);
  EXPECT_EQ(result.best()->columns, 25 + 6 + 6 * kPlacements);

  // A laser that looks aslant shows that shift.
  spec.measurement.head.lasers[1].axis = Vector3d(0.1, 0.2, 1).normalized();
  EXPECT_EQ(RankOf(independent::HeadJacobian(spec, truth, rows)), kDerived + 1);
  const Result aslant =
      IdentifyGeometry(spec, RecordHead(spec, truth, rows, kCameraNoise, 1), Progress());
  ASSERT_NE(aslant.best(), nullptr);
  EXPECT_EQ(aslant.best()->rank_numerical, kDerived + 1);
}

TEST(StraightEdge, WhatNoReadingShowsIsSaid) {
  const ProblemSpec spec = LoadCase("kr15_edges");
  const Result result = RunCase(spec);
  ASSERT_NE(result.best(), nullptr);
  auto parameters = ByName(*result.best());
  for (const Edge& edge : spec.robot.edges) {
    const ParameterResult& along = parameters.at("base_x." + edge.name);
    EXPECT_EQ(along.verdict, Verdict::kUnobservable);
    EXPECT_NE(along.explanation.find("along the ruler"), std::string::npos) << along.explanation;
    const ParameterResult& across = parameters.at("base_y." + edge.name);
    EXPECT_EQ(across.verdict, Verdict::kUnobservable);
    EXPECT_NE(across.explanation.find("across the edge"), std::string::npos) << across.explanation;
    for (const char* const turn : {"base_rx.", "base_ry.", "base_rz."}) {
      // They show, if only together with theta1, which turns the robot on its base.
      EXPECT_NE(parameters.at(turn + edge.name).verdict, Verdict::kUnobservable)
          << turn << edge.name;
    }
  }
  // d6 and tool_z act alike, and neither shows where all sights look along z.
  EXPECT_EQ(parameters.at("tool_z").verdict, Verdict::kUnobservable);
}

TEST(StraightEdge, ExactReadingsGiveExactPredictionsFromEdgesThatStandAnywhere) {
  const ProblemSpec placed = LoadCase("kr15_edges");
  const ProblemSpec spec = Unplaced(placed);
  const Recording rows = RowsOfCase(placed);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto truth = independent::MakeHeadTruth(placed, seed);
    const Result result = IdentifyGeometry(spec, RecordHead(spec, truth, rows, 0, 1), Progress());
    ASSERT_NE(result.best(), nullptr);
    EXPECT_TRUE(result.best()->converged) << result.best()->message;
    EXPECT_LT(result.best()->rms, 1e-9);
    EXPECT_LT(result.validation.rms_test, 1e-9);
    EXPECT_EQ(result.validation.rows, 4 * kPlacements);
    ASSERT_EQ(result.calibrated.edges.size(), static_cast<std::size_t>(kPlacements));
    // Only what readings show of an edge can be right: its plane, and the sense of the ruler.
    for (const Edge& edge : result.calibrated.edges) {
      const Isometry3d& X_BE = truth.edges.at(edge.name);
      const Vector3d n = X_BE.linear().col(2), x = X_BE.linear().col(0);
      EXPECT_LT((edge.X_WE->linear().col(2) - n).norm(), 0.02) << edge.name;
      EXPECT_LT((edge.X_WE->linear().col(0) - x).norm(), 0.02) << edge.name;
    }
  }
}

/// Share of the 95 % intervals of unseen readings (differences within an edge, predicted by the
/// fit) that hold the true reading: combinations of parameters that are estimable.
double CoverageOfUnseenReadings(int draws, double* largest_bias) {
  const ProblemSpec placed = LoadCase("kr15_edges");
  const ProblemSpec spec = Unplaced(placed);
  const Recording rows = RowsOfCase(placed);
  const double quantile = 1.959964;
  int covered = 0, count = 0;
  Eigen::VectorXd mean;
  for (int draw = 0; draw < draws; ++draw) {
    const auto seed = static_cast<std::uint64_t>(draw) + 1;
    const auto truth = independent::MakeHeadTruth(placed, 100 + seed);
    Recording recording = RecordHead(spec, truth, rows, kCameraNoise, seed);
    // Unseen rows hold what is true.
    const Recording exact = RecordHead(spec, truth, rows, 0, seed);
    for (int row = 0; row < rows.num_rows(); ++row) {
      if (rows.test(row)) recording.head.row(row) = exact.head.row(row);
    }
    Calibration c(spec, recording);
    // A pair of a fitted and an unseen row has the fitted row's noise.
    auto& test = c.readings.test;
    test.erase(
        std::remove_if(
            test.begin(), test.end(), [&](const Reading& r) { return !rows.test(r.previous_idx); }),
        test.end());
    AlignStart(&c);
    FitFramesAlone(&c, {});
    const Fit fit = RunFit(c, SettingsOf(c));
    const auto analysis = Analyse(c, fit);
    if (!analysis) {
      ADD_FAILURE() << "draw " << draw << ": " << fit.summary.message;
      continue;
    }
    RowNoise unit;
    unit.sigma = Eigen::VectorXd::Ones(recording.num_rows());
    const auto& coordinates = spec.measurement.kind.coordinates;
    Eigen::VectorXd standardised(0);
    RowsOf(c, test).Visit(fit.summary.state, unit, [&](const TileRows& tile) {
      const auto readings = static_cast<Eigen::Index>(tile.readings.size());
      const Eigen::MatrixXd variance =
          tile.J() * analysis->identifiability.covariance * tile.J().transpose();
      for (Eigen::Index k = 0; k < tile.r().size(); ++k) {
        ASSERT_LT(static_cast<std::size_t>(k / readings), coordinates.size());
        const double z = tile.r()[k] / std::sqrt(variance(k, k));
        standardised.conservativeResize(standardised.size() + 1);
        standardised.tail<1>()[0] = z;
        covered += std::abs(z) <= quantile ? 1 : 0;
        ++count;
      }
    });
    mean = draw == 0 ? standardised : Eigen::VectorXd(mean + standardised);
  }
  // In sigmas of a mean of so many draws.
  *largest_bias = mean.lpNorm<Eigen::Infinity>() / std::sqrt(draws);
  return static_cast<double>(covered) / count;
}

TEST(StraightEdge, IntervalsOfUnseenReadingsCoverInFewDraws) {
  double bias = 0;
  const double coverage = CoverageOfUnseenReadings(kSanitized ? 3 : 25, &bias);
  // 108 readings of some 70 combinations per draw: four standard deviations.
  EXPECT_NEAR(coverage, 0.95, kSanitized ? 0.08 : 0.025);
  EXPECT_LT(bias, 4.5);
}

TEST(StraightEdgeSlow, IntervalsOfUnseenReadingsCover) {
  double bias = 0;
  const double coverage = CoverageOfUnseenReadings(300, &bias);
  std::cout << "straight edges: " << 100 * coverage << " % of 95 % intervals cover\n";
  EXPECT_NEAR(coverage, 0.95, 0.01);
  EXPECT_LT(bias, 4.5);
}

}  // namespace
}  // namespace dhcal
