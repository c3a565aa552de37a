// calibrated.yaml: the problem file again, with the corrected robot as its nominal one. Built from
// the file itself, so that everything the corrections do not concern stays as the user wrote it.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/base/text.h"
#include "problems/formats/problem/robot_nodes.h"
#include "problems/formats/result/result_writer.h"

namespace dhcal {
namespace {

[[noreturn]] void ThrowChanged() {
  throw std::runtime_error("the problem file has changed since it was read");
}

bool IsFixedRow(const YAML::Node& row) {
  const YAML::Node type = Child(row, "type");
  return type.IsScalar() && type.Scalar() == "fixed";
}

/// Fixed rows are part of base and tool by now.
YAML::Node JointsNode(const RobotModel& calibrated, const YAML::Node& old) {
  if (!old.IsSequence()) ThrowChanged();
  YAML::Node joints(YAML::NodeType::Sequence);
  for (const YAML::Node& row : old) {
    if (IsFixedRow(row)) continue;
    if (joints.size() == calibrated.joints.size()) ThrowChanged();
    joints.push_back(JointNode(calibrated.joints[joints.size()], row));
  }
  if (joints.size() != calibrated.joints.size()) ThrowChanged();
  return joints;
}

/// Written only when it says something, so that a file without the key stays without.
bool Needed(const YAML::Node& old, const Eigen::Isometry3d& X, const std::vector<RunFrame>& runs) {
  return !old.IsNull() || !runs.empty() || !X.isApprox(Eigen::Isometry3d::Identity(), 0.0);
}

/// Gravity and payload are given in the frames at the ends, which fixed rows had moved.
void MoveToEnds(const RobotModel& calibrated, const YAML::Node& old_joints, YAML::Node* robot) {
  if (std::none_of(old_joints.begin(), old_joints.end(), IsFixedRow)) return;
  (*robot)["gravity_m_s2"] = FlowList(calibrated.gravity_B);
  if (!Child(*robot, "payload").IsNull()) (*robot)["payload"] = MassNode(calibrated.payload);
}

bool SameMasses(const std::vector<LinkMass>& a, const std::vector<LinkMass>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const LinkMass& x, const LinkMass& y) {
        return x.mass == y.mass && x.p_LC == y.p_LC;
      });
}

/// Rebuilt rather than changed in place: parts of the file may be shared through YAML aliases.
/// `units` goes, because every number written here names its own unit.
YAML::Node RobotNode(const RobotModel& calibrated, bool masses_changed, const YAML::Node& old) {
  // The rows are no longer those of the URDF, or those of the table and the maker's deltas.
  if (!Child(old, "urdf").IsNull() || !Child(old, "calibration_conf").IsNull()) {
    return NewRobotNode(calibrated, old);
  }
  YAML::Node robot(YAML::NodeType::Map);
  for (const auto& entry : old) {
    const std::string key = entry.first.Scalar();
    if (key != "units") robot[key] = entry.second;
  }
  const bool modified = calibrated.convention == DhConvention::kModified;
  if (modified || !Child(old, "convention").IsNull()) {
    robot["convention"] = modified ? "modified" : "standard";
  }
  robot["joints"] = JointsNode(calibrated, Child(old, "joints"));
  MoveToEnds(calibrated, Child(old, "joints"), &robot);
  const YAML::Node base = Child(old, "base");
  if (Needed(base, calibrated.X_WB, calibrated.base_of_run)) {
    robot["base"] = FrameNode(calibrated.X_WB, calibrated.base_of_run, base);
  }
  const YAML::Node tool = Child(old, "tool");
  if (Needed(tool, calibrated.X_TQ, calibrated.tool_of_run)) {
    robot["tool"] = FrameNode(calibrated.X_TQ, calibrated.tool_of_run, tool);
  }
  if (masses_changed) robot["links"] = LinksNode(calibrated.links);
  if (!calibrated.targets.empty()) {
    robot["targets"] = TargetsNode(calibrated.targets, Child(old, "targets"));
  }
  return robot;
}

/// The measurement with the edges where the fit has them.
YAML::Node MeasurementNode(const RobotModel& calibrated, const YAML::Node& old) {
  if (calibrated.edges.empty()) return old;
  YAML::Node measurement(YAML::NodeType::Map);
  for (const auto& entry : old) measurement[entry.first.Scalar()] = entry.second;
  YAML::Node edges(YAML::NodeType::Map);
  for (const Edge& edge : calibrated.edges) {
    YAML::Node node = FlowMap();
    if (edge.X_WE) SetPose(*edge.X_WE, &node);
    edges[edge.name] = node;
  }
  measurement["edges"] = edges;
  return measurement;
}

YAML::Node ValuesNode(const EffectRequest& effect) {
  YAML::Node values = FlowMap();
  for (const auto& [name, value] : effect.values) values[name] = Digits(value);
  return values;
}

/// An effect of the file with what was found for it; as it stands where it was held already.
YAML::Node EffectNode(const EffectRequest& effect, const YAML::Node& old) {
  if (!effect.held || !Child(old, "values").IsNull()) return old;
  YAML::Node node = Without({}, old);
  node["values"] = ValuesNode(effect);
  return node;
}

/// An effect that the file does not have.
YAML::Node FoundEffectNode(const EffectRequest& effect) {
  YAML::Node node = FlowMap();
  node["effect"] = effect.effect;
  if (effect.joint > 0) node["joint"] = std::to_string(effect.joint);
  for (const auto& [key, word] : effect.words) node[key] = word;
  for (const auto& [key, value] : effect.settings) node[key] = Digits(value);
  node["values"] = ValuesNode(effect);
  return node;
}

YAML::Node ParametersNode(const std::vector<EffectRequest>& effects, const YAML::Node& old) {
  YAML::Node parameters(YAML::NodeType::Map);
  if (old.IsMap()) {
    for (const auto& entry : old) parameters[entry.first.Scalar()] = entry.second;
  }
  const YAML::Node old_effects = Child(parameters, "effects");
  const std::size_t num_old = old_effects.IsSequence() ? old_effects.size() : 0;
  if (num_old > effects.size()) ThrowChanged();
  if (effects.empty()) return parameters;
  YAML::Node list(YAML::NodeType::Sequence);
  for (std::size_t k = 0; k < num_old; ++k) {
    list.push_back(EffectNode(effects[k], old_effects[k]));
  }
  for (std::size_t k = num_old; k < effects.size(); ++k) {
    list.push_back(FoundEffectNode(effects[k]));
  }
  parameters["effects"] = list;
  return parameters;
}

}  // namespace

std::string CalibratedYaml(const ProblemSpec& spec,
                           const RobotModel& calibrated,
                           const std::vector<EffectRequest>& effects,
                           const std::string& recording_path) {
  const YAML::Node original = YAML::LoadFile(spec.file);
  YAML::Node root(YAML::NodeType::Map);
  for (const auto& entry : original) {
    const std::string key = entry.first.Scalar();
    if (key == "recording" || key == "simulate") {
      root["recording"] = recording_path;
    } else if (key == "columns" && spec.columns.empty()) {
      continue;  // of a recording that is stored under the program's own names
    } else if (key == "robot") {
      const bool masses_changed = !SameMasses(calibrated.links, spec.robot.links);
      root["robot"] = RobotNode(calibrated, masses_changed, entry.second);
    } else if (key == "measurement") {
      root["measurement"] = MeasurementNode(calibrated, entry.second);
    } else if (key == "task" && spec.task && !spec.task->file.empty()) {
      root["task"]["poses"] = spec.task->file;
    } else if (key == "parameters") {
      root["parameters"] = ParametersNode(effects, entry.second);
    } else {
      root[key] = entry.second;
    }
  }
  if (Child(original, "parameters").IsNull() && !effects.empty()) {
    root["parameters"] = ParametersNode(effects, YAML::Node());
  }
  const bool held = std::any_of(
      effects.begin(), effects.end(), [](const EffectRequest& effect) { return effect.held; });
  YAML::Emitter emitter;
  emitter << root;
  return fmt::format(
             "# Made by ceres_dhcal from {}: the nominal values of the robot are the ones\n"
             "# identified from its recording{}.\n"
             "# Its other keys are as they were; its comments are gone.\n",
             Printable(std::filesystem::path(spec.file).filename().string()),
             held ? ", and its effects are held at what was found" : "") +
         emitter.c_str() + "\n";
}

}  // namespace dhcal
