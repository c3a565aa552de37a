// The head's own physics: each effect against a law written apart (tests/support/faulty_head.h),
// found again by a fit, named by a diagnosis, and left out of what is said of the robot.
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kinematics/head_sight.h"
#include "core/kinematics/inverse_kinematics.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/calibrate.h"
#include "problems/formats/result/result_writer.h"
#include "problems/frames.h"
#include "problems/identify.h"
#include "tests/support/edge_head.h"
#include "tests/support/faulty_head.h"
#include "tests/support/problem_cases.h"
#include "tests/support/sanitized.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using independent::FaultyNumbers;
using independent::HeadFaults;

constexpr double kNoiseOfCamera = 20e-6;  // [m], of the case
constexpr double kRulingPitch = 2e-3;     // [m]

/// The shipped case, whose rulings are 2 mm apart.
ProblemSpec CaseWithPitch() {
  ProblemSpec spec = LoadCase("kr15_edges");
  spec.measurement.head.pitch = kRulingPitch;
  spec.robot.head->pitch = kRulingPitch;
  return spec;
}

struct HeadCase {
  std::string name;
  EffectRequest request;  // with values
  HeadFaults faults;
  std::vector<std::string> compared;  // parameters that are the same about another middle
};

EffectRequest HeadRequest(const std::string& effect, const std::map<std::string, double>& values) {
  EffectRequest request;
  request.effect = effect;
  request.values = values;
  return request;
}

std::vector<HeadCase> HeadCases() {
  std::vector<HeadCase> cases;
  HeadFaults faults;
  faults.curvature = 3e-3;
  cases.push_back(
      {"edge_bow", HeadRequest("edge_bow", {{"curvature", 3e-3}}), faults, {"curvature"}});
  faults = {};
  faults.climb = 3e-4;
  cases.push_back({"edge_misalignment",
                   HeadRequest("edge_misalignment", {{"pitch", 3e-4}}),
                   faults,
                   {"pitch"}});
  faults = {};
  faults.higher = 8e-4;
  cases.push_back(
      {"camera_abbe", HeadRequest("camera_abbe", {{"height", 8e-4}}), faults, {"height"}});
  faults = {};
  faults.pixel = 0.03;
  cases.push_back(
      {"camera_scale", HeadRequest("camera_scale", {{"scale", 0.03}}), faults, {"scale"}});
  faults = {};
  faults.slant[1] = Vector3d(-1.5e-3, 2e-3, 0);
  EffectRequest tilt =
      HeadRequest("laser_tilt", {{"first_laser2", -1.5e-3}, {"second_laser2", 2e-3}});
  tilt.settings["laser"] = 2;
  cases.push_back({"laser_tilt", tilt, faults, {}});
  faults = {};
  faults.polynomial[0] = Vector3d(5e-4, 0.05, 2);
  EffectRequest bent = HeadRequest(
      "laser_linearity", {{"gain_laser1", 5e-4}, {"quadratic_laser1", 0.05}, {"cubic_laser1", 2}});
  bent.settings["laser"] = 1;
  cases.push_back({"laser_linearity", bent, faults, {"cubic_laser1"}});
  return cases;
}

/// Q in the edge of a row, by the independent kinematics.
Isometry3d PoseOverEdge(const ProblemSpec& spec,
                        const independent::HeadTruth& truth,
                        const Recording& rows,
                        int row) {
  const Isometry3d X_BQ(independent::PoseOfRow(spec, truth, rows, row));
  return truth.edges.at(rows.edge_names[static_cast<std::size_t>(rows.edge(row))]).inverse() * X_BQ;
}

independent::HeadTruth AsDrawn(const ProblemSpec& spec) {
  independent::HeadTruth truth;
  truth.delta = Eigen::VectorXd::Zero(42);
  for (const Edge& edge : spec.robot.edges) truth.edges[edge.name] = *edge.X_WE;
  return truth;
}

Recording RecordFaulty(const ProblemSpec& spec,
                       const independent::HeadTruth& truth,
                       const Recording& rows,
                       const HeadFaults& faults,
                       double noise,
                       std::uint64_t seed) {
  constexpr double kRuler0 = 0.3;
  return independent::RecordNumbers(spec, rows, noise, seed, [&](int row) {
    return FaultyNumbers(
        spec.measurement.head, faults, PoseOverEdge(spec, truth, rows, row), kRuler0);
  });
}

Recording RowsOverEdges(const ProblemSpec& spec) {
  Recording rows = RecordingOf(spec);
  rows.head.resize(0, 0);
  return rows;
}

class HeadEffect : public testing::TestWithParam<HeadCase> {};

TEST_P(HeadEffect, MovesTheNumbersAsItsLawDoes) {
  const ProblemSpec spec = CaseWithPitch();
  const Recording rows = RowsOverEdges(spec);
  const independent::HeadTruth truth = AsDrawn(spec);
  const PhysicsContext context(spec.robot, rows, Frames(spec.robot, rows).bases());
  const DhChain chain(spec.robot);
  const std::vector<EffectColumn> columns = EffectColumns(context, GetParam().request);
  Vector3d mean = Vector3d::Zero();
  std::map<int, std::pair<double, int>> along;  // of each edge
  for (int row = 0; row < rows.num_rows(); ++row) {
    const Vector3d numbers =
        FaultyNumbers(spec.measurement.head, {}, PoseOverEdge(spec, truth, rows, row));
    mean += numbers / rows.num_rows();
    along[rows.edge(row)].first += numbers[0];
    along[rows.edge(row)].second += 1;
  }
  for (int row = 0; row < rows.num_rows(); ++row) {
    Eigen::VectorXd delta = Eigen::VectorXd::Zero(42);
    for (const EffectColumn& column : columns) {
      for (const SlotWeights& slot : column.slots) {
        delta[slot.slot] += GetParam().request.values.at(column.parameter) * slot.weight[row];
      }
    }
    const Isometry3d X_EQ = chain.Pose<double>(
        rows.q.row(row).transpose(), delta, {context.X_WB(row), spec.robot.X_TQ});
    const auto seen = SightsOf(spec.measurement.head, X_EQ.translation(), X_EQ.linear());
    ASSERT_TRUE(seen);
    HeadFaults faults = GetParam().faults;
    faults.middle = along.at(rows.edge(row)).first / along.at(rows.edge(row)).second;
    faults.height0 = {mean[1], mean[2]};
    const Isometry3d X = PoseOverEdge(spec, truth, rows, row);
    const Vector3d without = FaultyNumbers(spec.measurement.head, {}, X);
    const Vector3d by_law = FaultyNumbers(spec.measurement.head, faults, X) - without;
    const Vector3d by_effect = seen->numbers() - without;
    // Of second order: the tilt that a height is written as (0.3 mm over 0.1 m), and the square of
    // a slant of 2.5 mrad at 70 mm.
    EXPECT_LT((by_effect - by_law).norm(), 1e-2 * by_law.norm() + 0.2e-6) << row;
  }
}

TEST_P(HeadEffect, IsFoundAgainByAFit) {
  ProblemSpec spec = CaseWithPitch();
  const Recording rows = RowsOverEdges(spec);
  HeadFaults faults = GetParam().faults;
  faults.middle = 0.03;  // wherever the bar is deepest
  faults.height0 = {0.06, 0.06};
  const auto truth = independent::MakeHeadTruth(spec, 7);
  const Recording recording = RecordFaulty(spec, truth, rows, faults, kNoiseOfCamera, 11);
  for (Edge& edge : spec.robot.edges) edge.X_WE.reset();
  EffectRequest request = GetParam().request;
  request.values.clear();
  spec.parameters.effects = {request};
  const Result result = IdentifyGeometry(spec, recording, Progress());
  ASSERT_NE(result.best(), nullptr);
  EXPECT_TRUE(result.best()->converged);
  // As many directions more as it has parameters: none of them hides among arm and placements.
  const auto own = static_cast<int>(GetParam().request.values.size());
  EXPECT_EQ(result.best()->rank, 24 - 1 + 4 * 12 + own);
  EXPECT_NEAR(result.validation.rms_test / kNoiseOfCamera, 1, 0.25);
  const auto parameters = ByName(*result.best());
  for (const std::string& name : GetParam().compared) {
    const ParameterResult& found = parameters.at(request.effect + "." + name);
    EXPECT_LT(std::abs(found.value - GetParam().request.values.at(name)), 4 * found.sigma) << name;
    EXPECT_LT(4 * found.sigma, std::abs(GetParam().request.values.at(name))) << name;
  }
}

TEST_P(HeadEffect, HasItsNameInADiagnosisAndLeavesTheRobotAsItIs) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  ProblemSpec spec = CaseWithPitch();
  const Recording rows = RowsOverEdges(spec);
  HeadFaults faults = GetParam().faults;
  faults.middle = 0.03;
  faults.height0 = {0.06, 0.06};
  const auto truth = independent::MakeHeadTruth(spec, 8);
  const Recording recording = RecordFaulty(spec, truth, rows, faults, kNoiseOfCamera, 12);
  const Result result = Calibrate(spec, recording, {});
  ASSERT_TRUE(result.diagnosis.has_value());
  const DiagnosisResult& diagnosis = *result.diagnosis;
  ASSERT_EQ(diagnosis.findings.size(), 1u) << diagnosis.summary;
  EXPECT_EQ(diagnosis.findings[0].effect.effect, GetParam().request.effect) << diagnosis.summary;
  EXPECT_EQ(diagnosis.findings[0].effect.settings, GetParam().request.settings);
  // The rows fitted beside it are those of the robot: one without it would be worse for any use.
  ASSERT_TRUE(result.delivered.has_value());
  EXPECT_FALSE(result.delivered->rigid.has_value());
}

TEST_P(HeadEffect, NeedsAHead) {
  const ProblemSpec spec = LoadCase("kr15");
  const Recording recording = RecordingOf(spec);
  const PhysicsContext context(spec.robot, recording, {spec.robot.X_WB});
  const Effect& effect = *FindEffect(GetParam().request.effect);
  for (const EffectRequest& request : effect.Candidates(context)) {
    EXPECT_THAT(effect.NotTestable(context, request), testing::HasSubstr("no head"));
  }
}

TEST_P(HeadEffect, IsNoPartOfTheRobot) {
  const ProblemSpec spec = CaseWithPitch();
  EXPECT_TRUE(FindEffect(GetParam().request.effect)->Describe().of_instrument);
  EXPECT_EQ(CalibratedPython("p", spec.robot, {GetParam().request}),
            CalibratedPython("p", spec.robot, {}));
}

std::string NameOfCase(const testing::TestParamInfo<HeadCase>& param) { return param.param.name; }

INSTANTIATE_TEST_SUITE_P(Faults, HeadEffect, testing::ValuesIn(HeadCases()), NameOfCase);

Result WithEffect(ProblemSpec spec, const std::string& effect, const Recording& recording) {
  spec.parameters.effects = {HeadRequest(effect, {})};
  return IdentifyGeometry(spec, recording, Progress());
}

TEST(HeadEffects, AScaleAloneIsSaidToBeHidden) {
  const ProblemSpec spec = LoadCase("kr15_edges");
  const Recording recording = RecordingOf(spec);
  const Result result = WithEffect(spec, "sensor_scale", recording);
  ASSERT_NE(result.best(), nullptr);
  EXPECT_EQ(result.best()->rank, 24 - 1 + 48);  // as without it
  const Verdict verdict = ByName(*result.best()).at("sensor_scale.scale").verdict;
  EXPECT_TRUE(verdict == Verdict::kConfounded || verdict == Verdict::kUnobservable);
}

TEST(HeadEffects, ASecondStandardOfLengthShowsTheScale) {
  ProblemSpec spec = LoadCase("kr15_edges");
  spec.simulate->effects = {HeadRequest("sensor_scale", {{"scale", 5e-4}})};
  spec.simulate->row_errors(JointSlot::kA)[1] = 0;
  const Recording recording = RecordingOf(spec);
  // A length of the arm that was measured by itself.
  spec.parameters.fix = {"a2"};
  const Result result = WithEffect(spec, "sensor_scale", recording);
  ASSERT_NE(result.best(), nullptr);
  const ParameterResult scale = ByName(*result.best()).at("sensor_scale.scale");
  EXPECT_EQ(scale.verdict, Verdict::kIdentified);
  EXPECT_LT(std::abs(scale.value - 5e-4), 4 * scale.sigma);
}

/// The case's rows with the tool upright over its placements.
Recording Upright(const ProblemSpec& spec) {
  Recording rows = RowsOverEdges(spec);
  const InverseKinematics inverse(spec.robot);
  const ChainState as_drawn{Eigen::VectorXd::Zero(42), {Isometry3d::Identity(), spec.robot.X_TQ}};
  const independent::HeadTruth truth = AsDrawn(spec);
  for (int row = 0; row < rows.num_rows(); ++row) {
    Isometry3d X_EQ = PoseOverEdge(spec, truth, rows, row);
    X_EQ.linear() = Eigen::Quaterniond::FromTwoVectors(X_EQ.linear().col(2), -Vector3d::UnitZ()) *
                    X_EQ.linear();
    const auto& edge = rows.edge_names[static_cast<std::size_t>(rows.edge(row))];
    const InverseSolution reached =
        inverse.Solve(truth.edges.at(edge) * X_EQ, as_drawn, rows.q.row(row).transpose());
    EXPECT_TRUE(reached.found) << row << ": " << reached.reason;
    rows.q.row(row) = reached.q.transpose();
  }
  return rows;
}

TEST(HeadEffects, AToolThatKeepsUprightShowsNeitherClimbNorHeightOfTheRulings) {
  const ProblemSpec spec = LoadCase("kr15_edges");
  const Recording recording =
      RecordFaulty(spec, AsDrawn(spec), Upright(spec), {}, kNoiseOfCamera, 3);
  for (const char* const effect : {"edge_misalignment.pitch", "camera_abbe.height"}) {
    const std::string name = effect;
    const Result result = WithEffect(spec, name.substr(0, name.find('.')), recording);
    ASSERT_NE(result.best(), nullptr);
    const ParameterResult hidden = ByName(*result.best()).at(name);
    EXPECT_TRUE(hidden.verdict == Verdict::kUnobservable || hidden.verdict == Verdict::kConfounded)
        << name << " " << hidden.explanation;
    EXPECT_FALSE(hidden.explanation.empty()) << name;
  }
}

}  // namespace
}  // namespace dhcal
