#include "problems/formats/problem/problem_reader.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/temp_file.h"

namespace dhcal {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using testing::UnorderedElementsAre;

const char kGoodFolder[] = DHCAL_SOURCE_DIR "/tests/data/good/";

ProblemSpec ReadPath(const std::string& path, const std::string& data_dir = "") {
  Diagnostics diagnostics;
  const std::optional<ProblemSpec> spec = ReadProblemFile(path, data_dir, &diagnostics);
  EXPECT_EQ(diagnostics.ToString(), "");
  EXPECT_TRUE(spec.has_value());
  return spec.value_or(ProblemSpec());
}

ProblemSpec ReadGood(const std::string& name) { return ReadPath(kGoodFolder + name); }

ProblemSpec ReadText(const std::string& text, const std::string& data_dir = "") {
  return ReadPath(TempFile(text, ".yaml").path(), data_dir);
}

/// A small problem with further lines.
std::string WithLines(const std::string& lines) {
  return "schema: 1\nrobot: {joints: [{a_m: 0.3, alpha_deg: 90}, {a_m: 0.2}]}\n"
         "measurement: {kind: position}\n" +
         lines;
}

TEST(ProblemReader, ReadsTheRobotsRowsInSi) {
  const ProblemSpec spec = ReadGood("all_keys.yaml");
  EXPECT_EQ(spec.name, "kr15");
  EXPECT_EQ(spec.robot.name, "KUKA KR 15/2");
  EXPECT_EQ(spec.robot.convention, DhConvention::kModified);
  ASSERT_EQ(spec.robot.num_joints(), 3);
  const JointRow& first = spec.robot.joints[0];
  EXPECT_EQ(first.name, "A1");
  EXPECT_DOUBLE_EQ(first.theta, kPi / 2);
  EXPECT_EQ(first.d, 0.675);
  EXPECT_EQ(first.a, 0.3);
  EXPECT_DOUBLE_EQ(first.alpha, -kPi / 2);
  EXPECT_EQ(first.beta, 0);
  EXPECT_EQ(first.sign, 1);
}

TEST(ProblemReader, KeysWithoutUnitHaveTheStatedUnits) {
  const JointRow second = ReadGood("all_keys.yaml").robot.joints.at(1);
  EXPECT_EQ(second.theta, 0.5);
  EXPECT_DOUBLE_EQ(second.d, 0.020);
  EXPECT_DOUBLE_EQ(second.a, 0.650);
  EXPECT_EQ(second.alpha, -0.25);
  EXPECT_EQ(second.beta, 0.125);
  EXPECT_EQ(second.sign, -1);
}

TEST(ProblemReader, KeysWithUnitOutrankTheStatedUnits) {
  const JointRow third = ReadGood("all_keys.yaml").robot.joints.at(2);
  EXPECT_EQ(third.name, "J3");
  EXPECT_EQ(third.type, JointType::kPrismatic);
  EXPECT_EQ(third.theta, 1);
  EXPECT_DOUBLE_EQ(third.d, 0.155);
  EXPECT_DOUBLE_EQ(third.a, -0.005);
  EXPECT_EQ(third.alpha, 2);
  EXPECT_DOUBLE_EQ(third.beta, kPi);
}

TEST(ProblemReader, KeysWithoutUnitAreDegreesAndMetresByDefault) {
  const ProblemSpec spec = ReadText(
      "schema: 1\nrobot: {joints: [{theta: 180, d: 2}]}\nmeasurement: {kind: position}\n"
      "recording: a.csv\n");
  EXPECT_DOUBLE_EQ(spec.robot.joints.at(0).theta, kPi);
  EXPECT_EQ(spec.robot.joints.at(0).d, 2);
}

TEST(ProblemReader, PosesTurnAboutFixedAxesXThenYThenZ) {
  const RobotModel robot = ReadGood("all_keys.yaml").robot;
  EXPECT_TRUE(robot.X_WB.translation().isApprox(Eigen::Vector3d(0.1, 0.2, 0.3)));
  // Roll 90 deg takes y to z, yaw 90 deg leaves z; roll takes z to -y, yaw takes -y to x.
  EXPECT_TRUE((robot.X_WB.linear() * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE((robot.X_WB.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
}

TEST(ProblemReader, ReadsFramesPerRun) {
  const RobotModel robot = ReadGood("all_keys.yaml").robot;
  EXPECT_TRUE(robot.base_per_run);
  EXPECT_FALSE(robot.tool_per_run);
  ASSERT_EQ(robot.base_of_run.size(), 2u);
  EXPECT_EQ(robot.base_of_run[0].run, "morning");
  EXPECT_EQ(robot.base_of_run[0].X.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_DOUBLE_EQ(Eigen::AngleAxisd(robot.base_of_run[0].X.linear()).angle(), 0.5);
  EXPECT_EQ(robot.base_of_run[1].run, "evening");
  EXPECT_TRUE(robot.base_of_run[1].X.matrix().isIdentity(0));
}

TEST(ProblemReader, ReadsTargetsAndMasses) {
  const RobotModel robot = ReadGood("all_keys.yaml").robot;
  ASSERT_EQ(robot.targets.size(), 2u);
  EXPECT_EQ(robot.targets[1].name, "B");
  EXPECT_TRUE(robot.targets[1].X_TQ.translation().isApprox(Eigen::Vector3d(0, 0.1, 0.2)));
  EXPECT_EQ(robot.gravity_B, Eigen::Vector3d(0, 9.81, 0));
  ASSERT_EQ(robot.links.size(), 3u);
  EXPECT_EQ(robot.links[0].mass, 40);
  EXPECT_EQ(robot.links[0].p_LC, Eigen::Vector3d(-0.3, 0, 0.1));
  EXPECT_EQ(robot.links[2].mass, 3) << "through a YAML alias";
  EXPECT_EQ(robot.payload.mass, 5);
  EXPECT_TRUE(robot.payload.p_LC.isApprox(Eigen::Vector3d(0, 0, 0.1)));
}

TEST(ProblemReader, ReadsTheMeasurement) {
  const MeasurementSpec measurement = ReadGood("all_keys.yaml").measurement;
  EXPECT_EQ(measurement.kind.name, "pose");
  EXPECT_DOUBLE_EQ(measurement.sigma.value(), 0.02e-3);
  EXPECT_DOUBLE_EQ(measurement.sigma_rotation.value(), 0.1e-3);
  EXPECT_EQ(measurement.noise, NoiseKind::kIndependent);
}

TEST(ProblemReader, ReadsAnchorsOfDistances) {
  const MeasurementSpec measurement = ReadGood("distance.yaml").measurement;
  EXPECT_EQ(measurement.kind.name, "distance");
  ASSERT_EQ(measurement.anchors.size(), 2u);
  EXPECT_EQ(measurement.anchors[1].name, "east");
  EXPECT_EQ(measurement.anchors[1].p_WA, Eigen::Vector3d(0, 2, 0));
}

TEST(ProblemReader, ReadsTheHeadAndItsEdges) {
  const ProblemSpec spec = ReadGood("straight_edge.yaml");
  const MeasurementSpec& measurement = spec.measurement;
  EXPECT_EQ(measurement.noise, NoiseKind::kSharedPose);
  EXPECT_DOUBLE_EQ(measurement.sigma.value(), 20e-6);
  EXPECT_DOUBLE_EQ(measurement.kind.coordinates[1].noise, 0.5);
  EXPECT_DOUBLE_EQ(measurement.kind.coordinates[2].noise, 1.5);
  EXPECT_TRUE(measurement.head.camera.p_QS.isApprox(Eigen::Vector3d(0.02, 0, 0)));
  EXPECT_EQ(measurement.head.camera.axis, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(measurement.head.lasers[0].axis.isApprox(Eigen::Vector3d(0, 0.6, 0.8)));
  EXPECT_DOUBLE_EQ(measurement.head.ruler_height, 0.004);
  ASSERT_EQ(spec.robot.edges.size(), 2u);
  EXPECT_TRUE(spec.robot.base_per_edge);
  ASSERT_TRUE(spec.robot.edges[0].X_WE.has_value());
  EXPECT_TRUE(spec.robot.edges[0].X_WE->linear().col(0).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_EQ(spec.robot.edges[1].name, "south");
  EXPECT_FALSE(spec.robot.edges[1].X_WE.has_value());
  EXPECT_EQ(spec.parameters.estimate, std::vector<std::string>{"complete"});

  const ProblemSpec named = ReadGood("straight_edge_names.yaml");
  ASSERT_EQ(named.robot.edges.size(), 2u);
  EXPECT_EQ(named.robot.edges[0].name, "north");
  EXPECT_FALSE(named.robot.edges[0].X_WE.has_value());
}

TEST(ProblemReader, ReadsParametersAndPriorsInSi) {
  const ParameterSpec parameters = ReadGood("all_keys.yaml").parameters;
  EXPECT_THAT(parameters.estimate,
              ElementsAre("theta", "alpha2", "base_rx.morning", "tool_z.A", "complete"));
  EXPECT_THAT(parameters.fix, ElementsAre("alpha3"));
  EXPECT_THAT(parameters.prior_sigma,
              UnorderedElementsAre(Pair("a", testing::DoubleEq(0.5e-3)),
                                   Pair("theta", testing::DoubleEq(kPi)),
                                   Pair("theta3", testing::DoubleEq(2e-3)),
                                   Pair("tool_z", 0.25),
                                   Pair("base:m", testing::DoubleEq(1e-3)),
                                   Pair("base:rad", 3.0)));
  EXPECT_EQ(parameters.where.line, 27);
}

TEST(ProblemReader, OneNameMayStandWithoutAList) {
  const ProblemSpec spec =
      ReadText(WithLines("recording: a.csv\nparameters: {estimate: complete}\n"));
  EXPECT_THAT(spec.parameters.estimate, ElementsAre("complete"));
}

TEST(ProblemReader, ReadsTheSolver) {
  const SolverSpec solver = ReadGood("all_keys.yaml").solver;
  EXPECT_EQ(solver.method, SolverMethod::kBoth);
  EXPECT_EQ(solver.kappa, 1e-9);
  EXPECT_EQ(solver.rule, TruncationRule::kRelative);
  EXPECT_EQ(solver.relative_tolerance, 3e-5);
  EXPECT_EQ(solver.max_iterations, 20);
  EXPECT_EQ(solver.loss, LossKind::kHuber);
  EXPECT_EQ(solver.loss_scale, 2.5);
}

TEST(ProblemReader, AbsentSectionsKeepTheirDefaults) {
  const ProblemSpec spec = ReadGood("position.yaml");
  EXPECT_EQ(spec.name, "position") << "the file's name";
  EXPECT_EQ(spec.robot.convention, DhConvention::kStandard);
  EXPECT_EQ(spec.robot.joints.at(1).name, "J2");
  EXPECT_FALSE(spec.measurement.sigma.has_value());
  EXPECT_THAT(spec.parameters.estimate, ElementsAre("complete")) << "an instrument stands beside";
  EXPECT_EQ(spec.solver.method, SolverMethod::kSvdGaussNewton);
  EXPECT_EQ(spec.solver.rule, TruncationRule::kNoise);
  EXPECT_FALSE(spec.simulate.has_value());
}

TEST(ProblemReader, RecordingIsFoundBesideTheProblem) {
  const ProblemSpec spec = ReadGood("all_keys.yaml");
  EXPECT_EQ(spec.recording, std::string(kGoodFolder) + "rows/kr15.csv");
  EXPECT_EQ(spec.recording_where.line, 26);
  EXPECT_EQ(spec.recording_where.column, 12);
}

TEST(ProblemReader, AbsoluteRecordingStaysAsItIs) {
  EXPECT_EQ(ReadText(WithLines("recording: /tmp/a.csv\n")).recording, "/tmp/a.csv");
}

TEST(ProblemReader, DataVariableIsReplaced) {
  const std::string text = WithLines("recording: ${DHCAL_DATA}/ur10/a.csv\n");
  EXPECT_EQ(ReadText(text, "/data").recording, "/data/ur10/a.csv");
  EXPECT_EQ(ReadText(text, "/data/").recording, "/data/ur10/a.csv");
}

TEST(ProblemReader, ReadsASimulationInSi) {
  const ProblemSpec spec = ReadGood("simulated.yaml");
  EXPECT_THAT(spec.recording, IsEmpty());
  ASSERT_TRUE(spec.simulate.has_value());
  const SimulationSpec& simulate = *spec.simulate;
  EXPECT_EQ(simulate.motion.kind, MotionKind::kIncrements);
  EXPECT_EQ(simulate.motion.num_poses, 12);
  EXPECT_TRUE(simulate.motion.home.isApprox(Eigen::Vector2d(0, kPi / 2)));
  EXPECT_TRUE(simulate.motion.increments.isApprox(Eigen::Vector2d(-3, 3.6) * kDegree));
  EXPECT_TRUE(simulate.row_errors(JointSlot::kTheta).isApprox(Eigen::Vector2d(0.001, 0.002)));
  EXPECT_TRUE(simulate.row_errors(JointSlot::kAlpha).isApprox(Eigen::Vector2d(kPi, 0)));
  EXPECT_TRUE(simulate.row_errors(JointSlot::kA).isApprox(Eigen::Vector2d(0.003, 0.004)));
  EXPECT_EQ(simulate.row_errors(JointSlot::kD), Eigen::Vector2d(0.5, 0.6));
  EXPECT_EQ(simulate.row_errors(JointSlot::kBeta), Eigen::Vector2d(0, 7));
  ASSERT_EQ(simulate.base.size(), 6);
  EXPECT_TRUE(simulate.base.head<3>().isApprox(Eigen::Vector3d(1, 2, 3) * 1e-3));
  EXPECT_EQ(simulate.base.tail<3>(), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(simulate.tool.head<3>(), Eigen::Vector3d::Zero());
  EXPECT_TRUE(simulate.tool.tail<3>().isApprox(Eigen::Vector3d(7, 8, 9) * 1e-3));
  EXPECT_DOUBLE_EQ(simulate.noise, 0.02e-3);
  EXPECT_DOUBLE_EQ(simulate.noise_rotation, kPi);
  EXPECT_EQ(simulate.seed, 18446744073709551615u);
}

TEST(ProblemReader, RandomMotionTurnsEveryJointRoundByDefault) {
  const ProblemSpec spec = ReadText(WithLines("simulate: {motion: {kind: random, poses: 3}}\n"));
  EXPECT_EQ(spec.simulate->motion.num_poses, 3);
  EXPECT_EQ(spec.simulate->motion.lower, Eigen::Vector2d(-kPi, -kPi));
  EXPECT_EQ(spec.simulate->motion.upper, Eigen::Vector2d(kPi, kPi));
}

TEST(ProblemReader, RobotWithASlideTakesItsMotionInSi) {
  const ProblemSpec spec = ReadText(
      "schema: 1\nrobot: {joints: [{a_m: 1}, {type: prismatic}]}\nmeasurement: {kind: position}\n"
      "simulate: {motion: {kind: increments, home: [1.5, 0.2], increments: [0.1, 0.01]}}\n");
  EXPECT_EQ(spec.simulate->motion.home, Eigen::Vector2d(1.5, 0.2));
  EXPECT_EQ(spec.simulate->motion.increments, Eigen::Vector2d(0.1, 0.01));
}

TEST(ProblemReader, MotionFileIsFoundBesideTheProblem) {
  const TempFile file(WithLines("simulate: {motion: {kind: file, file: poses.csv}}\n"), ".yaml");
  const ProblemSpec spec = ReadPath(file.path());
  EXPECT_EQ(spec.simulate->motion.kind, MotionKind::kFile);
  EXPECT_EQ(std::filesystem::path(spec.simulate->motion.file),
            std::filesystem::path(file.path()).parent_path() / "poses.csv");
}

TEST(ProblemReader, ByteOrderMarkAndCrlfChangeNothing) {
  const ProblemSpec spec = ReadText(
      "\xEF\xBB\xBFschema: 1\r\nname: a b\r\nrobot: {joints: [{a_m: 0.3}]}\r\n"
      "measurement:\r\n  kind: position\r\nrecording: a.csv\r\n");
  EXPECT_EQ(spec.name, "a b");
  EXPECT_EQ(spec.robot.joints.at(0).a, 0.3);
}

TEST(ProblemReader, UnusuallyLargeEntryIsAWarning) {
  const TempFile file(
      "schema: 1\nrobot: {joints: [{theta_rad: 90, a_m: 300}]}\n"
      "measurement: {kind: position}\nrecording: a.csv\n",
      ".yaml");
  Diagnostics diagnostics;
  EXPECT_TRUE(ReadProblemFile(file.path(), "", &diagnostics).has_value());
  ASSERT_EQ(diagnostics.all().size(), 2u);
  EXPECT_THAT(diagnostics.all()[0].ToString(),
              HasSubstr(":2:30: warning: 'robot.joints[1].theta_rad' is 90, which is unusually"));
  EXPECT_THAT(diagnostics.all()[1].message, HasSubstr("'robot.joints[1].a_m' is 300"));
}

TEST(ProblemReader, ErrorsComeInTheOrderOfTheirPlaces) {
  const TempFile file(
      "shema: 1\nrobot: {joints: [{a_m: x}]}\nmeasurement: {kind: position}\nrecording: a.csv\n",
      ".yaml");
  Diagnostics diagnostics;
  EXPECT_EQ(ReadProblemFile(file.path(), "", &diagnostics), std::nullopt);
  ASSERT_EQ(diagnostics.all().size(), 3u);
  EXPECT_THAT(diagnostics.all()[0].message, HasSubstr("lacks the key 'schema'"));
  EXPECT_THAT(diagnostics.all()[1].message, HasSubstr("did you mean 'schema'?"));
  EXPECT_THAT(diagnostics.all()[2].message, HasSubstr("is 'x'"));
}

TEST(ProblemReader, DeeplyNestedRubbishIsRefused) {
  for (const char bracket : {'[', '{'}) {
    const TempFile file(std::string(100000, bracket), ".yaml");
    Diagnostics diagnostics;
    EXPECT_EQ(ReadProblemFile(file.path(), "", &diagnostics), std::nullopt);
    EXPECT_EQ(diagnostics.num_errors(), 1);
  }
}

TEST(ProblemReader, AliasOfItselfIsRefused) {
  const TempFile file("&a\nschema: 1\nrobot: *a\nmeasurement: *a\nrecording: *a\n", ".yaml");
  Diagnostics diagnostics;
  EXPECT_EQ(ReadProblemFile(file.path(), "", &diagnostics), std::nullopt);
}

}  // namespace
}  // namespace dhcal
