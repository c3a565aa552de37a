#include "problems/simulate.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glog/logging.h>

#include "core/base/rng.h"
#include "core/base/text.h"
#include "core/kinematics/dh_chain.h"
#include "core/model/joint_numbers.h"
#include "core/physics/registry.h"
#include "problems/formats/recording/recording_reader.h"
#include "problems/frames.h"
#include "problems/line_motion.h"
#include "residuals/registry.h"

namespace dhcal {
namespace {

/// Joint columns; from a motion file also what else it says about its rows (clock, payload,
/// temperature, directions, speeds, torques, runs), which effects may need.
std::optional<Recording> Motion(const ProblemSpec& spec, Rng* rng, Diagnostics* diagnostics) {
  const MotionSpec& motion = spec.simulate->motion;
  if (motion.kind == MotionKind::kLine) return LineMotion(spec, rng, diagnostics);
  if (motion.kind == MotionKind::kFile) {
    std::optional<Recording> file = ReadRecording(motion.file, spec.robot.joints, diagnostics);
    if (!file) return std::nullopt;
    for (Eigen::MatrixXd* const measured :
         {&file->p_WQ, &file->displacement, &file->quaternion, &file->head}) {
      measured->resize(0, 0);
    }
    file->distance.resize(0);
    file->sigma.resize(0);
    file->target_names.clear();
    file->target_idx.clear();
    file->anchor_names.clear();
    file->anchor_idx.clear();
    file->lines.clear();
    return file;
  }
  Recording rows;
  rows.q.resize(motion.num_poses, spec.robot.num_joints());
  for (int pose = 0; pose < motion.num_poses; ++pose) {
    for (int joint = 0; joint < rows.q.cols(); ++joint) {
      rows.q(pose, joint) = motion.kind == MotionKind::kIncrements
                                ? motion.home[joint] + pose * motion.increments[joint]
                                : rng->Uniform(motion.lower[joint], motion.upper[joint]);
    }
  }
  return rows;
}

/// `source` with each row `times` times in a row.
Eigen::MatrixXd Repeated(const Eigen::MatrixXd& source, int times) {
  Eigen::MatrixXd rows(source.rows() * times, source.cols());
  for (Eigen::Index k = 0; k < rows.rows(); ++k) rows.row(k) = source.row(k / times);
  return rows;
}

/// Each pose is measured on every target.
Recording OnEveryTarget(const Recording& motion, const RobotModel& robot) {
  Recording rows = motion;
  const auto num_targets = static_cast<int>(robot.targets.size());
  for (const Target& target : robot.targets) rows.target_names.push_back(target.name);
  if (num_targets == 0) return rows;
  for (Eigen::MatrixXd* const column :
       {&rows.q, &rows.temperature, &rows.direction, &rows.speed, &rows.torque}) {
    *column = Repeated(*column, num_targets);
  }
  for (Eigen::VectorXd* const column : {&rows.time, &rows.payload}) {
    *column = Repeated(*column, num_targets);
  }
  for (ExtraColumn& column : rows.extra) column.values = Repeated(column.values, num_targets);
  rows.run_idx.clear();
  rows.edge_idx.clear();
  rows.is_test.clear();
  for (int k = 0; k < rows.num_rows(); ++k) {
    const auto pose = static_cast<std::size_t>(k / num_targets);
    rows.target_idx.push_back(k % num_targets);
    if (!motion.run_idx.empty()) rows.run_idx.push_back(motion.run_idx[pose]);
    if (!motion.edge_idx.empty()) rows.edge_idx.push_back(motion.edge_idx[pose]);
    if (!motion.is_test.empty()) rows.is_test.push_back(motion.is_test[pose]);
  }
  return rows;
}

/// Simulated runs share one base; edges have one each.
std::vector<Eigen::Isometry3d> BasesOf(const RobotModel& robot, const Recording& rows) {
  if (!robot.base_per_edge) return {robot.X_WB};
  return Frames(robot, rows).bases();
}

/// Slot perturbations of every row by the effects put in (slots x rows), which load the arm that
/// `arm` describes. Nothing, with an error added, when one cannot be simulated with these rows.
std::optional<Eigen::MatrixXd> EffectSlots(const ProblemSpec& spec,
                                           const Recording& rows,
                                           const Eigen::MatrixXd& arm,
                                           Diagnostics* diagnostics) {
  const PhysicsContext context(spec.robot, rows, BasesOf(spec.robot, rows), arm);
  Eigen::MatrixXd delta = Eigen::MatrixXd::Zero(context.slots().size(), rows.num_rows());
  bool ok = true;
  const auto refuse = [&](const EffectRequest& request, const std::string& reason) {
    diagnostics->Error(
        request.where,
        fmt::format("the effect {} cannot be simulated: {}", InstanceName(request), reason));
    ok = false;
  };
  for (const EffectRequest& request : spec.simulate->effects) {
    const std::string reason = FindEffect(request.effect)->NotTestable(context, request);
    if (!reason.empty()) {
      refuse(request, reason);
      continue;
    }
    std::map<std::string, double> values = request.values;
    std::vector<std::string> names;
    for (const EffectColumn& column : EffectColumns(context, request)) {
      names.push_back(column.parameter);
      for (const SlotWeights& weights : column.slots) {
        delta.row(weights.slot) += values[column.parameter] * weights.weight.transpose();
      }
      values.erase(column.parameter);
    }
    for (const auto& [name, value] : values) {
      refuse(request,
             fmt::format(
                 "it has no parameter '{}'; its parameters are {}", name, fmt::join(names, ", ")));
    }
  }
  if (!ok) return std::nullopt;
  return delta;
}

/// Gives every row an edge of the file: that of the motion file, else stretches of rows the edges
/// in turn. False, with an error added, where an edge has no pose to simulate at.
bool LabelEdges(const ProblemSpec& spec, Recording* rows, Diagnostics* diagnostics) {
  const std::vector<Edge>& edges = spec.robot.edges;
  if (rows->edge_idx.empty() && !edges.empty()) {
    for (const Edge& edge : edges) rows->edge_names.push_back(edge.name);
    const auto num_edges = static_cast<int>(edges.size());
    for (int row = 0; row < rows->num_rows(); ++row) {
      rows->edge_idx.push_back(row * num_edges / rows->num_rows());
    }
  }
  std::vector<std::string> missing;
  for (const std::string& name : rows->edge_names) {
    const bool known = std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      return edge.name == name && edge.X_WE;
    });
    if (!known) missing.push_back(name);
  }
  if (!rows->edge_names.empty() && missing.empty()) return true;
  diagnostics->Error(
      spec.measurement.where,
      fmt::format("a simulation needs the pose of every edge; give 'measurement.edges' {}",
                  missing.empty() ? "at least one with its pose"
                                  : "the pose of " + QuotedList(missing, "and")));
  return false;
}

/// The frames at both ends of the chain of every row; errors of the base that all edges see alike
/// move from `errors` into them.
std::vector<EndFrames> EndsOfRows(const RobotModel& nominal,
                                  const Recording& rows,
                                  Eigen::VectorXd* errors) {
  RobotModel robot = nominal;
  // Simulated runs share one base.
  robot.base_per_run = robot.tool_per_run = false;
  if (robot.base_per_edge) {
    auto base = errors->segment<6>(SlotLayout(robot.num_joints()).base(0));
    robot.X_WB = PerturbFrame<double>(robot.X_WB, base);
    base.setZero();
  }
  const Frames frames(robot, rows);
  std::vector<EndFrames> ends;
  for (int row = 0; row < rows.num_rows(); ++row) {
    ends.push_back(frames.ends({rows.run(row), rows.target(row), std::max(rows.edge(row), 0)}));
  }
  return ends;
}

}  // namespace

Eigen::VectorXd ErrorSlots(const RobotModel& robot, const SimulationSpec& simulation) {
  const SlotLayout slots(robot.num_joints());
  Eigen::VectorXd delta = Eigen::VectorXd::Zero(slots.size());
  for (const JointNumber& number : kJointNumbers) {
    const Eigen::VectorXd& errors = simulation.row_errors(number.slot);
    for (int joint = 0; joint < errors.size(); ++joint) {
      delta[slots.joint(joint, number.slot)] = errors[joint];
    }
  }
  if (simulation.base.size() > 0) delta.segment<6>(slots.base(0)) = simulation.base;
  if (simulation.tool.size() > 0) delta.segment<6>(slots.tool(0)) = simulation.tool;
  return delta;
}

std::optional<Recording> SimulateRecording(const ProblemSpec& spec, Diagnostics* diagnostics) {
  CHECK(spec.simulate.has_value());
  Rng rng(spec.simulate->seed);
  const std::optional<Recording> motion = Motion(spec, &rng, diagnostics);
  if (!motion) return std::nullopt;
  return SimulateAt(spec, *motion, &rng, diagnostics);
}

std::optional<Recording> SimulateAt(const ProblemSpec& spec,
                                    const Recording& motion,
                                    Rng* rng,
                                    Diagnostics* diagnostics) {
  CHECK(spec.simulate.has_value());
  const RobotModel& robot = spec.robot;
  Recording recording = OnEveryTarget(motion, robot);
  recording.file = spec.file;
  if (robot.base_per_edge && !LabelEdges(spec, &recording, diagnostics)) return std::nullopt;
  Eigen::VectorXd errors = ErrorSlots(robot, *spec.simulate);
  const std::vector<EndFrames> ends = EndsOfRows(robot, recording, &errors);
  Eigen::MatrixXd arm = errors.replicate(1, recording.num_rows());
  for (int turn = 0; turn < kBends; ++turn) {
    const std::optional<Eigen::MatrixXd> physics = EffectSlots(spec, recording, arm, diagnostics);
    if (!physics) return std::nullopt;
    arm = physics->colwise() + errors;
  }
  const DhChain chain(robot);
  std::vector<Eigen::Isometry3d> X_WQ;
  for (int row_idx = 0; row_idx < recording.num_rows(); ++row_idx) {
    X_WQ.push_back(chain.Pose<double>(recording.q.row(row_idx).transpose(),
                                      arm.col(row_idx),
                                      ends[static_cast<std::size_t>(row_idx)]));
  }
  const ReadingNoise noise{spec.simulate->noise, spec.simulate->noise_rotation};
  FindMeasurementType(spec.measurement.kind.name)
      ->Simulate(spec.measurement, X_WQ, noise, rng, &recording);
  return recording;
}

}  // namespace dhcal
