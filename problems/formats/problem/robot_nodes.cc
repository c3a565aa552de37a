#include "problems/formats/problem/robot_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/math/rotation.h"
#include "core/model/joint_numbers.h"

namespace dhcal {
namespace {

/// The degrees whose radians come closest to `angle`: the quotient may be off by one last bit.
double DegreesOf(double angle) {
  const double quotient = angle / kDegree;
  double best = quotient;
  for (const double towards : {-HUGE_VAL, HUGE_VAL}) {
    const double neighbour = std::nextafter(quotient, towards);
    if (std::abs(neighbour * kDegree - angle) < std::abs(best * kDegree - angle)) best = neighbour;
  }
  return best;
}

/// Written only when it says something.
bool IsIdentity(const Eigen::Isometry3d& X) {
  return X.isApprox(Eigen::Isometry3d::Identity(), 0.0);
}

YAML::Node LimitsNode(const JointRow& joint) {
  const bool angle = joint.type == JointType::kRevolute;
  YAML::Node list(YAML::NodeType::Sequence);
  list.SetStyle(YAML::EmitterStyle::Flow);
  for (const double limit : {joint.lower, joint.upper}) {
    list.push_back(Digits(angle ? DegreesOf(limit) : limit));
  }
  return list;
}

}  // namespace

std::string Digits(double value) { return fmt::format("{}", value + 0.0); }  // + 0.0: no "-0"

YAML::Node FlowMap() {
  YAML::Node map(YAML::NodeType::Map);
  map.SetStyle(YAML::EmitterStyle::Flow);
  return map;
}

YAML::Node FlowList(const Eigen::Vector3d& numbers) {
  YAML::Node list(YAML::NodeType::Sequence);
  list.SetStyle(YAML::EmitterStyle::Flow);
  for (const double number : numbers) list.push_back(Digits(number));
  return list;
}

YAML::Node Child(const YAML::Node& map, const std::string& key) {
  if (!map.IsMap()) return YAML::Node();
  const YAML::Node child = map[key];
  return child.IsDefined() ? child : YAML::Node();
}

YAML::Node Without(const std::vector<std::string>& stems, const YAML::Node& map) {
  YAML::Node rest = FlowMap();
  if (!map.IsMap()) return rest;
  for (const auto& entry : map) {
    const std::string key = entry.first.Scalar();
    if (std::count(stems.begin(), stems.end(), key.substr(0, key.find('_'))) == 0)
      rest[key] = entry.second;
  }
  return rest;
}

YAML::Node JointNode(const JointRow& joint, const YAML::Node& old) {
  std::vector<std::string> stems;
  for (const JointNumber& number : kJointNumbers) stems.emplace_back(number.name);
  YAML::Node node = Without(stems, old);
  // In the order that a row is usually written in: theta, d, a, alpha.
  for (std::size_t slot = 0; slot < kNumJointNumbers; ++slot) {
    const JointNumber& number = NumberOf(static_cast<JointSlot>(slot));
    const double value = joint.*number.value;
    // A plain DH row has no beta.
    if (number.slot == JointSlot::kBeta && value == 0) continue;
    const bool angle = number.unit == Unit::kRadian;
    node[number.name + std::string(angle ? "_deg" : "_m")] =
        Digits(angle ? DegreesOf(value) : value);
  }
  // A cure of the files may have turned it.
  if (joint.sign < 0 || !Child(node, "sign").IsNull()) node["sign"] = joint.sign < 0 ? "-1" : "1";
  return node;
}

void SetPose(const Eigen::Isometry3d& X, YAML::Node* node) {
  const Eigen::Vector3d rpy = RpyFromRotation(X.linear());
  (*node)["xyz_m"] = FlowList(X.translation());
  (*node)["rpy_deg"] = FlowList({DegreesOf(rpy.x()), DegreesOf(rpy.y()), DegreesOf(rpy.z())});
}

YAML::Node FrameNode(const Eigen::Isometry3d& X,
                     const std::vector<RunFrame>& frames_of_runs,
                     const YAML::Node& old) {
  YAML::Node node = Without({"xyz", "rpy", "runs"}, old);
  SetPose(X, &node);
  if (frames_of_runs.empty()) return node;
  node["per_run"] = "true";
  YAML::Node runs(YAML::NodeType::Map);
  for (const RunFrame& frame : frames_of_runs) {
    YAML::Node run = FlowMap();
    SetPose(frame.X, &run);
    runs[frame.run] = run;
  }
  node["runs"] = runs;
  node.SetStyle(YAML::EmitterStyle::Block);
  return node;
}

YAML::Node TargetsNode(const std::vector<Target>& targets, const YAML::Node& old) {
  YAML::Node node(YAML::NodeType::Map);
  for (const Target& target : targets) {
    node[target.name] = FrameNode(target.X_TQ, {}, Child(old, target.name));
  }
  return node;
}

YAML::Node MassNode(const LinkMass& link) {
  YAML::Node node = FlowMap();
  node["mass_kg"] = Digits(link.mass);
  node["com_m"] = FlowList(link.p_LC);
  return node;
}

YAML::Node LinksNode(const std::vector<LinkMass>& links) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (const LinkMass& link : links) list.push_back(MassNode(link));
  return list;
}

YAML::Node NewJointNode(const JointRow& joint) {
  YAML::Node start = FlowMap();
  start["name"] = joint.name;
  if (joint.type == JointType::kPrismatic) start["type"] = "prismatic";
  YAML::Node node = JointNode(joint, start);
  if (std::isfinite(joint.lower) && std::isfinite(joint.upper)) {
    node[joint.type == JointType::kRevolute ? "limits_deg" : "limits_m"] = LimitsNode(joint);
  }
  return node;
}

YAML::Node NewRobotNode(const RobotModel& robot, const YAML::Node& old) {
  YAML::Node node(YAML::NodeType::Map);
  const YAML::Node name = Child(old, "name");
  if (!name.IsNull()) {
    node["name"] = name;
  } else if (!robot.name.empty()) {
    node["name"] = robot.name;
  }
  node["convention"] = robot.convention == DhConvention::kModified ? "modified" : "standard";
  YAML::Node joints(YAML::NodeType::Sequence);
  for (const JointRow& joint : robot.joints) joints.push_back(NewJointNode(joint));
  node["joints"] = joints;
  const YAML::Node base = Child(old, "base"), tool = Child(old, "tool");
  if (!base.IsNull() || !IsIdentity(robot.X_WB) || !robot.base_of_run.empty()) {
    node["base"] = FrameNode(robot.X_WB, robot.base_of_run, base);
    if (robot.base_per_run) node["base"]["per_run"] = "true";
  }
  if (!robot.targets.empty()) {
    node["targets"] = TargetsNode(robot.targets, Child(old, "targets"));
  } else if (!tool.IsNull() || !IsIdentity(robot.X_TQ) || !robot.tool_of_run.empty()) {
    node["tool"] = FrameNode(robot.X_TQ, robot.tool_of_run, tool);
    if (robot.tool_per_run) node["tool"]["per_run"] = "true";
  }
  if (robot.gravity_B != RobotModel().gravity_B) {
    node["gravity_m_s2"] = FlowList(robot.gravity_B);
  }
  if (!robot.links.empty()) node["links"] = LinksNode(robot.links);
  // A column of the recording may have the mass.
  if (robot.payload.mass != 0 || !robot.payload.p_LC.isZero(0)) {
    node["payload"] = MassNode(robot.payload);
  }
  return node;
}

}  // namespace dhcal
