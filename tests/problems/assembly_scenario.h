// Small calibrations made by hand, with readings taken from the independent kinematics at known
// parameter errors: what BuildProblem is judged by.
#ifndef DHCAL_TESTS_PROBLEMS_ASSEMBLY_SCENARIO_H_
#define DHCAL_TESTS_PROBLEMS_ASSEMBLY_SCENARIO_H_

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/rng.h"
#include "problems/calibration.h"
#include "residuals/registry.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/robots.h"

namespace dhcal {

/// What a scenario is made of.
struct ScenarioOptions {
  std::string name;
  RobotModel robot;
  MeasurementKind kind = KindNamed("position");
  int num_rows = 12;
  bool two_runs = false;  // rows 0, 1, 2 of each six are of the first
  bool targets = false;   // rows alternate between A and B
  std::vector<std::string> recorded_targets = {"A", "B"};  // in the order of their first rows
  bool base_per_run = false;
  bool tool_per_run = false;
  bool row_sigmas = false;  // every row its own, except the last
  bool shared_pose = false;
  bool displacements = false;  // recorded as such, not as positions
  std::vector<std::string> estimate = {"complete"};
};

/// Owns all that a Calibration refers to.
struct AssemblyScenario {
  ProblemSpec spec;
  Recording recording;
  std::unique_ptr<Calibration> calibration;
  Eigen::VectorXd truth;  // state at which the readings were taken

  /// Pose of a row by the independent kinematics: parameters and frames are found by their names.
  Eigen::Matrix4d IndependentPose(const Eigen::VectorXd& state, int row_idx) const {
    const RobotModel& robot = spec.robot;
    const std::string run = NameOf(recording.run_names, recording.run_idx, row_idx);
    const std::string target = NameOf(recording.target_names, recording.target_idx, row_idx);
    Eigen::VectorXd delta = Eigen::VectorXd::Zero(5 * robot.num_joints() + 12);
    for (std::size_t k = 0; k < calibration->parameters.size(); ++k) {
      const Parameter& parameter = calibration->parameters[k];
      const std::size_t dot = parameter.name.find('.');
      const std::string owner = dot == std::string::npos ? "" : parameter.name.substr(dot + 1);
      if (!owner.empty() && owner != run && owner != target) continue;
      delta[parameter.slot] += state[static_cast<Eigen::Index>(k)];
    }
    Eigen::Isometry3d X_WB = robot.X_WB, X_TQ = robot.X_TQ;
    for (const RunFrame& frame : robot.base_of_run) {
      if (robot.base_per_run && frame.run == run) X_WB = frame.X;
    }
    for (const RunFrame& frame : robot.tool_of_run) {
      if (robot.tool_per_run && frame.run == run) X_TQ = frame.X;
    }
    for (const Target& candidate : robot.targets) {
      if (candidate.name == target) X_TQ = candidate.X_TQ;
    }
    const Eigen::VectorXd q = recording.q.row(row_idx).transpose();
    return independent::ForwardKinematics<double>(robot, q, delta, X_WB, X_TQ);
  }

  static std::string NameOf(const std::vector<std::string>& names,
                            const std::vector<int>& idx,
                            int row_idx) {
    return idx.empty() ? ""
                       : names[static_cast<std::size_t>(idx[static_cast<std::size_t>(row_idx)])];
  }
};

inline ProblemSpec MakeSpec(const ScenarioOptions& options) {
  ProblemSpec spec;
  spec.name = options.name;
  spec.robot = options.robot;
  spec.robot.base_per_run = options.base_per_run;
  spec.robot.tool_per_run = options.tool_per_run;
  if (options.base_per_run) {
    spec.robot.base_of_run = {{"second", MakeFrame({-1, 0.2, 0.1}, {0, 0.1, 2})}};
  }
  if (options.tool_per_run) {
    spec.robot.tool_of_run = {{"first", MakeFrame({0.1, 0, 0.3}, {0.5, 0, 0})}};
  }
  if (options.targets) {
    spec.robot.targets = {{"A", MakeFrame({0.1, 0, 0.2}, {0, 0, 0.4})},
                          {"B", MakeFrame({-0.1, 0.15, 0.1}, {0.3, 0, 0})}};
  }
  spec.measurement.kind = options.kind;
  spec.measurement.noise = options.shared_pose ? NoiseKind::kSharedPose : NoiseKind::kIndependent;
  spec.measurement.anchors = {{"near", {2.5, 1, 0}}, {"far", {-3, 2, 4}}};
  spec.parameters.estimate = options.estimate;
  return spec;
}

/// Joints and labels; the readings' columns are there and zero.
inline Recording MakeRows(const ScenarioOptions& options, Rng* rng) {
  Recording recording;
  recording.q.resize(options.num_rows, options.robot.num_joints());
  recording.p_WQ.setZero(options.num_rows, 3);
  if (options.displacements) recording.displacement.setZero(options.num_rows, 3);
  recording.quaternion.setZero(options.num_rows, 4);
  recording.distance.setZero(options.num_rows);
  recording.anchor_names = {"far", "near"};
  if (options.two_runs) recording.run_names = {"first", "second"};
  if (options.targets) recording.target_names = options.recorded_targets;
  if (options.row_sigmas) recording.sigma.resize(options.num_rows);
  for (int row = 0; row < options.num_rows; ++row) {
    recording.q.row(row) = RandomJoints(options.robot, rng).transpose();
    recording.anchor_idx.push_back(row % 3 == 0 ? 0 : 1);
    if (options.two_runs) recording.run_idx.push_back(row % 6 < 3 ? 0 : 1);
    if (options.targets) recording.target_idx.push_back(row % 2);
    if (options.row_sigmas) recording.sigma[row] = 0.2 + 0.1 * row;
  }
  if (options.row_sigmas) recording.sigma.tail(1)[0] = std::numeric_limits<double>::quiet_NaN();
  return recording;
}

/// Fills the readings with those of the independent kinematics at `state`.
inline void TakeReadings(const Eigen::VectorXd& state, AssemblyScenario* scenario) {
  Recording& recording = scenario->recording;
  for (int row = 0; row < recording.num_rows(); ++row) {
    const Eigen::Matrix4d X = scenario->IndependentPose(state, row);
    recording.p_WQ.row(row) = X.topRightCorner<3, 1>().transpose();
    const Eigen::Quaterniond q(Eigen::Matrix3d(X.topLeftCorner<3, 3>()));
    recording.quaternion.row(row) << q.w(), q.x(), q.y(), q.z();
    const std::string name =
        AssemblyScenario::NameOf(recording.anchor_names, recording.anchor_idx, row);
    for (const Anchor& anchor : scenario->spec.measurement.anchors) {
      if (anchor.name != name) continue;
      recording.distance[row] = (recording.p_WQ.row(row).transpose() - anchor.p_WA).norm();
    }
  }
  for (const Reading& reading : scenario->calibration->readings.fitted) {
    if (recording.displacement.rows() == 0) break;
    recording.displacement.row(reading.row_idx) =
        recording.p_WQ.row(reading.row_idx) - recording.p_WQ.row(reading.previous_idx);
  }
  // What was recorded as displacements has no positions.
  if (recording.displacement.rows() > 0) recording.p_WQ.resize(0, 3);
}

inline std::unique_ptr<AssemblyScenario> MakeScenario(const ScenarioOptions& options) {
  Rng rng(42);
  auto scenario = std::make_unique<AssemblyScenario>();
  scenario->spec = MakeSpec(options);
  scenario->recording = MakeRows(options, &rng);
  scenario->calibration = std::make_unique<Calibration>(scenario->spec, scenario->recording);
  scenario->truth.resize(static_cast<Eigen::Index>(scenario->calibration->parameters.size()));
  for (double& value : scenario->truth) value = rng.Uniform(-0.05, 0.05);
  TakeReadings(scenario->truth, scenario.get());
  return scenario;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_PROBLEMS_ASSEMBLY_SCENARIO_H_
