// calibrated.py against the program: the same poses to 1e-12.
#include <chrono>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/io/process.h"
#include "core/kinematics/dh_chain.h"
#include "core/physics/context.h"
#include "core/physics/registry.h"
#include "problems/formats/result/python_values.h"
#include "problems/formats/result/result_writer.h"
#include "tests/support/robots.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

constexpr double kSame = 1e-12;  // [m] and of rotation matrices
constexpr std::chrono::seconds kPythonTime(60);
constexpr int kPoses = 40;
constexpr double kCarried = 7;  // [kg]

EffectRequest Held(const std::string& effect,
                   int joint,
                   const std::map<std::string, double>& values,
                   const std::map<std::string, double>& settings = {}) {
  EffectRequest request;
  request.effect = effect;
  request.joint = joint;
  request.values = values;
  request.settings = settings;
  request.held = true;
  return request;
}

RobotModel WithMasses(RobotModel robot) {
  Rng rng(41);
  for (int i = 0; i < robot.num_joints(); ++i) {
    LinkMass link;
    link.mass = rng.Uniform(2, 40);
    link.p_LC = Eigen::Vector3d(rng.Uniform(-0.3, 0.3), rng.Uniform(-0.3, 0.3), 0.1);
    robot.links.push_back(link);
  }
  robot.payload.mass = 3;
  robot.payload.p_LC = Eigen::Vector3d(0.02, -0.05, 0.1);
  return robot;
}

Recording RandomPoses(const RobotModel& robot) {
  Rng rng(5);
  Recording recording;
  recording.q.resize(kPoses, robot.num_joints());
  recording.direction.resize(kPoses, robot.num_joints());
  recording.payload = Eigen::VectorXd::Constant(kPoses, kCarried);
  for (int k = 0; k < kPoses; ++k) {
    recording.q.row(k) = RandomJoints(robot, &rng).transpose();
    for (int j = 0; j < robot.num_joints(); ++j) {
      recording.direction(k, j) = rng.Uniform(-1, 1) > 0 ? 1 : -1;
    }
  }
  return recording;
}

/// What the effects' own columns add to the slots, of the arm as it stands with `deltas`.
Eigen::MatrixXd AddedBy(const std::vector<EffectRequest>& effects,
                        const RobotModel& robot,
                        const Recording& recording,
                        const Eigen::MatrixXd& deltas) {
  const PhysicsContext context(robot, recording, {robot.X_WB}, deltas);
  Eigen::MatrixXd added = Eigen::MatrixXd::Zero(deltas.rows(), deltas.cols());
  for (const EffectRequest& request : effects) {
    const Effect* const effect = FindEffect(request.effect);
    EXPECT_EQ(effect->NotTestable(context, request), "") << request.effect;
    std::size_t used = 0;
    for (const EffectColumn& column : effect->Columns(context, request)) {
      const auto value = request.values.find(column.parameter);
      if (value == request.values.end()) continue;
      ++used;
      for (const SlotWeights& weights : column.slots) {
        added.row(weights.slot) += value->second * weights.weight.transpose();
      }
    }
    EXPECT_EQ(used, request.values.size()) << request.effect;
  }
  return added;
}

/// The program's poses, rows of twelve numbers.
Eigen::MatrixXd PosesOf(const std::vector<EffectRequest>& effects,
                        const RobotModel& robot,
                        const Recording& recording) {
  const DhChain chain(robot);
  Eigen::MatrixXd deltas = Eigen::MatrixXd::Zero(chain.slots().size(), recording.num_rows());
  for (int bend = 0; bend <= kBends; ++bend) deltas = AddedBy(effects, robot, recording, deltas);
  Eigen::MatrixXd poses(recording.num_rows(), 12);
  for (int k = 0; k < recording.num_rows(); ++k) {
    const Eigen::VectorXd q = recording.q.row(k).transpose(), delta = deltas.col(k);
    const Eigen::Matrix<double, 3, 4> pose =
        chain.Pose<double>(q, delta, {robot.X_WB, robot.X_TQ}).matrix().topRows<3>();
    for (int i = 0; i < 3; ++i) poses.row(k).segment<4>(4 * i) = pose.row(i);
  }
  return poses;
}

/// What `program` prints when it runs beside calibrated.py.
std::string RunBeside(const std::string& module, const std::string& program) {
  const TempFolder folder;
  WriteFile(folder / "calibrated.py", module);
  WriteFile(folder / "program.py", program);
  const ProcessOutput output = RunForOutput(
      {"sh", "-c", "python3 -B '" + (folder / "program.py") + "' 2>&1"}, "", kPythonTime);
  EXPECT_EQ(output.end, ProcessOutput::End::kDone);
  return output.text;
}

std::string RowList(const Eigen::MatrixXd& rows) {
  std::vector<std::string> lines;
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    std::vector<std::string> numbers;
    for (Eigen::Index j = 0; j < rows.cols(); ++j) numbers.push_back(PythonNumber(rows(k, j)));
    lines.push_back(fmt::format("[{}]", fmt::join(numbers, ", ")));
  }
  return PythonList(lines);
}

Eigen::MatrixXd PythonPoses(const std::vector<EffectRequest>& effects,
                            const RobotModel& robot,
                            const Recording& recording) {
  const std::string printed =
      RunBeside(CalibratedPython("robot", robot, effects),
                fmt::format("from calibrated import forward\nfor q, s in zip({}, {}):\n"
                            "    pose = forward(q, payload={}, direction=s)\n"
                            "    print(*[repr(x) for row in pose[:3] for x in row])\n",
                            RowList(recording.q),
                            RowList(recording.direction),
                            kCarried));
  std::istringstream numbers(printed);
  Eigen::MatrixXd poses = Eigen::MatrixXd::Constant(recording.num_rows(), 12, 1e9);
  for (int k = 0; k < recording.num_rows(); ++k) {
    for (int i = 0; i < 12; ++i) numbers >> poses(k, i);
  }
  EXPECT_FALSE(numbers.fail()) << printed;
  return poses;
}

void ExpectSamePoses(const std::vector<EffectRequest>& effects, const RobotModel& robot) {
  const Recording recording = RandomPoses(robot);
  const Eigen::MatrixXd ours = PosesOf(effects, robot, recording);
  const Eigen::MatrixXd theirs = PythonPoses(effects, robot, recording);
  EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), kSame);
}

TEST(CalibratedPy, HasTheProgramsForwardKinematics) {
  for (const TestRobot& robot : TestRobots()) {
    SCOPED_TRACE(robot.model.name);
    ExpectSamePoses({}, robot.model);
  }
}

TEST(CalibratedPy, HoldsEffectsOfThePose) {
  const std::vector<EffectRequest> effects = {
      Held("joint_compliance", 2, {{"compliance", 3e-6}}),
      Held("torsion_nonlinearity", 3, {{"cubic", -1e-11}}),
      Held("torsion_nonlinearity", 2, {{"soft", 1e-6}}, {{"soft_torque_Nm", 60}}),
      Held("gravity_balancer",
           2,
           {{"sin_1", 2e-4}, {"cos_1", -1e-4}, {"sin_2", 3e-5}, {"cos_2", 1e-5}}),
      Held("link_bending", 2, {{"flexibility", 1e-6}}),
      Held("base_compliance", 0, {{"compliance_x", 2e-7}, {"compliance_y", 3e-7}}),
      Held("joint_gain", 4, {{"gain", 2e-4}}),
      Held("joint_coupling", 5, {{"coupling", 3e-4}}, {{"driver_joint", 4}}),
      Held("gear_harmonic", 3, {{"sin_121.02", 7e-5}, {"cos_121.02", 3e-5}}, {{"order", 121.0203}}),
      Held("transmission_error",
           1,
           {{"at_30", 3e-4}, {"at_-90", 1e-4}, {"at_120", 2e-4}},
           {{"knot_deg", 30}}),
      Held("axis_wobble", 1, {{"x", 5e-5}, {"y", -2e-5}}, {{"order", 2}}),
      Held("backlash", 4, {{"width", 3e-4}}),
      Held("backlash", 3, {{"width", 2e-4}}, {{"flank", 1}}),
      Held("backlash", 2, {{"width", 2e-4}}, {{"flank", 1}, {"friction_Nm", 200}})};
  for (const RobotModel& robot : {Kr15(), Kr15Modified()}) {
    SCOPED_TRACE(robot.name);
    ExpectSamePoses(effects, WithMasses(robot));
  }
}

TEST(CalibratedPy, HoldsEffectsOfUnknownMasses) {
  const std::vector<EffectRequest> effects = {
      Held("joint_compliance", 3, {{"compliance_x_link3_x", 4e-5}}),
      Held("backlash",
           4,
           {{"width", 3e-4}},
           {{"flank", 1}, {"moment_link", 5}, {"moment_deg", 70}, {"friction_Nm", 2}}),
      Held("backlash",
           3,
           {{"width", 2e-4}},
           {{"flank", 1}, {"moment_link", 3}, {"moment_deg", 25}})};
  for (const RobotModel& robot : {Kr15(), Kr15Modified()}) {
    SCOPED_TRACE(robot.name);
    ExpectSamePoses(effects, robot);
  }
}

TEST(CalibratedPy, FindsJointsThatReachAPose) {
  const RobotModel robot = WithMasses(Kr15());
  const std::string printed = RunBeside(
      CalibratedPython("robot", robot, {Held("joint_compliance", 2, {{"compliance", 3e-6}})}),
      "from calibrated import forward, inverse\n"
      "q = [0.3, -0.9, 0.7, 0.4, -0.8, 0.2]\n"
      "found = inverse(forward(q), [x + 0.1 for x in q])\n"
      "print(max(abs(a - b) for a, b in zip(q, found)) < 1e-8)\n"
      "point = [row[3] for row in forward(q)[:3]]\n"
      "there = [row[3] for row in forward(inverse(point, [x + 0.1 for x in q]))[:3]]\n"
      "print(max(abs(a - b) for a, b in zip(point, there)) < 1e-9)\n"
      "try:\n    inverse([90.0, 0.0, 0.0], q)\nexcept ValueError as error:\n    print(error)\n");
  EXPECT_THAT(printed, HasSubstr("True\nTrue\nnot reached from this start; "));
}

TEST(CalibratedPy, DoesNotPretendToHoldWhatItLeavesOut) {
  const std::string printed = RunBeside(
      CalibratedPython("robot", Kr15(), {Held("base_drift", 0, {{"x", 1e-3}})}),
      "import calibrated\n"
      "try:\n    calibrated.forward([0.0] * 6)\nexcept RuntimeError as error:\n    print(error)\n"
      "print(len(calibrated.forward([0.0] * 6, incomplete=True)))\n");
  EXPECT_THAT(printed, HasSubstr("this file cannot hold: base_drift"));
  EXPECT_THAT(printed, HasSubstr("\n4\n"));
}

TEST(CalibratedPy, HasTheFramesOfRunsAndTargets) {
  RobotModel robot = Kr15();
  robot.base_per_run = true;
  robot.base_of_run = {{"mon\"day\\", MakeFrame({1, 2, 3}, {0, 0, 0.1})},
                       {"tuesday", MakeFrame({4, 5, 6}, {0, 0.2, 0})}};
  const std::string printed = RunBeside(
      CalibratedPython("'''\"\"\" \n name", robot, {}),
      "import calibrated\n"
      "p = [calibrated.forward([0.0] * 6, run=r)[2][3] for r in ('mon\"day\\\\', 'tuesday')]\n"
      "print(p[0] != p[1], calibrated.NAME == chr(39) * 3 + chr(34) * 3 + ' ' + chr(10) + ' "
      "name')\n"
      "try:\n    calibrated.forward([0.0] * 6, run='x')\nexcept ValueError as error:\n"
      "    print(error)\n");
  EXPECT_THAT(printed, HasSubstr("True True\nno run 'x'; there are: mon\"day\\, tuesday"));
}

}  // namespace
}  // namespace dhcal
