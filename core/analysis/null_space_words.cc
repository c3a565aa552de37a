#include "core/analysis/null_space_words.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glog/logging.h>

#include "core/analysis/null_space.h"
#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/kinematics/dh_chain.h"
#include "core/kinematics/slots.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostNamed = 8;
constexpr int kPoses = 12;
constexpr double kNothing = 1e-3;  // of the robot's reach: millimetres

/// Parameters by name, and where in the chain they act.
class Names {
 public:
  Names(const RobotModel& robot, const std::vector<Parameter>& parameters)
      : slots_(robot.num_joints()) {
    for (const Parameter& parameter : parameters) by_name_[parameter.name] = &parameter;
  }

  const Parameter& at(const std::string& name) const {
    const auto found = by_name_.find(name);
    CHECK(found != by_name_.end()) << name;
    return *found->second;
  }
  bool in_group(const std::string& name, ParameterGroup group) const {
    return at(name).group == group;
  }
  /// Joint (from 0) of a joint's parameter, -1 for base and tool.
  int joint(const std::string& name) const {
    const int slot = at(name).slot;
    if (slot < 0) return -1;
    return slots_.is_joint(slot) ? SlotLayout::JointOf(slot) : -1;
  }

 private:
  SlotLayout slots_;
  std::map<std::string, const Parameter*> by_name_;
};

std::string Join(const std::vector<std::string>& items, const std::string& last_separator) {
  std::string text;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k > 0) text += k + 1 == items.size() ? last_separator : ", ";
    text += items[k];
  }
  return text;
}

/// " + d3", " - 0.34 m/rad theta5".
std::string Term(double coefficient, const Parameter& parameter, Unit unit_of_sum) {
  std::string text = coefficient < 0 ? " - " : " + ";
  const bool plain = std::abs(std::abs(coefficient) - 1.0) < 5e-3;
  if (parameter.unit != unit_of_sum || parameter.unit == Unit::kOther) {
    text += fmt::format("{:.3g} {}/{} ",
                        std::abs(coefficient),
                        ToString(unit_of_sum),
                        parameter.unit == Unit::kOther ? "(" + parameter.unit_text + ")"
                                                       : ToString(parameter.unit));
  } else if (!plain) {
    text += fmt::format("{:.3g} ", std::abs(coefficient));
  }
  return text + parameter.name;
}

/// All entries are offsets d of joints whose axes are mutually parallel.
bool IsParallelOffsets(const RobotModel& robot, const Names& names, const NullDirection& n) {
  for (const NullDirection::Entry& entry : n.direction) {
    if (!names.in_group(entry.name, ParameterGroup::kD)) return false;
    if (!AxesParallel(robot, names.joint(n.direction[0].name), names.joint(entry.name))) {
      return false;
    }
  }
  return n.direction.size() >= 2;
}

/// "only d2 + d3 + d4 is determined: axes 2, 3 and 4 are parallel": d_i acts along axis i, so that
/// along parallel axes only their sum moves anything. One sentence for all such directions that
/// share a joint.
std::string ParallelOffsets(const RobotModel& robot,
                            const Names& names,
                            const NullDirection& one,
                            const std::vector<NullDirection>& all) {
  std::set<int> joints;
  const int first = names.joint(one.direction[0].name);
  for (const NullDirection& other : all) {
    if (!IsParallelOffsets(robot, names, other)) continue;
    if (!AxesParallel(robot, first, names.joint(other.direction[0].name))) continue;
    for (const auto& entry : other.direction) joints.insert(names.joint(entry.name));
  }
  std::string sum;
  std::vector<std::string> axes;
  double sense = 1;
  int before = *joints.begin();
  for (const int joint : joints) {
    // A twist of 180 degrees turns the next axis round.
    for (int k = before; k < joint; ++k) {
      sense *= std::cos(robot.joints[robot.row_between(k)].alpha) < 0 ? -1 : 1;
    }
    before = joint;
    const std::string number = std::to_string(joint + 1);
    sum += sum.empty() ? "d" + number : (sense < 0 ? " - d" : " + d") + number;
    axes.push_back(number);
  }
  return fmt::format("only {} is determined: axes {} are parallel", sum, Join(axes, " and "));
}

/// How one slot moves the measured point at poses all over the joint space. All of it is seen
/// unweighted: a tight prior or a truncation may hide a parameter that moves the point well.
struct PointMove {
  double move = 0;    // largest, per unit of the slot
  double change = 0;  // largest change of the move from pose to pose
  double reach = 0;   // largest move per radian of any joint or of the base
};

/// The tools that a parameter's rows may carry.
std::vector<Eigen::Isometry3d> Tools(const RobotModel& robot, const Parameter& parameter) {
  std::vector<Eigen::Isometry3d> tools;
  for (std::size_t k = 0; k < robot.targets.size(); ++k) {
    RowLabels row = parameter.scope.row();
    row.target = static_cast<int>(k);
    if (!parameter.scope.Holds(row)) continue;
    tools.push_back(robot.targets[k].X_TQ);
  }
  for (const RunFrame& frame : robot.tool_of_run) tools.push_back(frame.X);
  if (tools.empty()) tools.push_back(robot.X_TQ);
  return tools;
}

PointMove MoveBy(const RobotModel& robot, const Parameter& parameter) {
  const DhChain chain(robot);
  const SlotLayout& slots = chain.slots();
  const Eigen::VectorXd no_delta = Eigen::VectorXd::Zero(slots.size());
  PointMove seen;
  for (const Eigen::Isometry3d& X_TQ : Tools(robot, parameter)) {
    Rng rng(20250);
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    for (int k = 0; k < kPoses; ++k) {
      Eigen::VectorXd q(robot.num_joints());
      for (int j = 0; j < robot.num_joints(); ++j) {
        const bool turns = robot.joints[static_cast<std::size_t>(j)].type == JointType::kRevolute;
        q[j] = turns ? rng.Uniform(-kPi, kPi) : rng.Uniform(-0.5, 0.5);
      }
      PoseWithDerivatives pose;
      chain.PoseAndDerivatives(q, no_delta, {robot.X_WB, X_TQ}, &pose);
      const Eigen::Vector3d move = pose.J_p.col(parameter.slot);
      if (k == 0) first = move;
      seen.move = std::max(seen.move, move.norm());
      seen.change = std::max(seen.change, (move - first).norm());
      for (int slot = 0; slot < slots.tool(0); ++slot) {
        if (slots.is_angle(slot)) {
          seen.reach = std::max(seen.reach, pose.J_p.col(slot).norm());
        }
      }
    }
  }
  return seen;
}

/// Why the geometry hides one parameter from all readings of a kind, or "" where it does not.
std::string GeometryHides(const RobotModel& robot,
                          const MeasurementKind& kind,
                          const Parameter& parameter) {
  // A measured orientation shows every turn, and a length moves the point itself.
  if (parameter.slot < 0) return "";
  for (const HiddenFreedom& hidden : kind.hidden) {
    const int slot = SlotLayout(robot.num_joints()).base(hidden.base_component);
    if (parameter.group == ParameterGroup::kBase && parameter.slot == slot) return hidden.why;
  }
  if (kind.turns_show()) return "";
  const PointMove seen = MoveBy(robot, parameter);
  if (parameter.unit == Unit::kRadian) {
    if (seen.move > kNothing * seen.reach) return "";
    return parameter.group == ParameterGroup::kTool
               ? "turns the tool about the measured point: only a measured orientation shows it"
               : "turns about an axis through the measured point: no reading depends on it";
  }
  if (kind.sees_offset || seen.change > kNothing) return "";
  return "shifts all measured points alike: differences of readings do not show it";
}

std::string One(const RobotModel& robot, const MeasurementKind& kind, const Parameter& parameter) {
  const std::string reason = GeometryHides(robot, kind, parameter);
  if (!reason.empty()) return parameter.name + " " + reason;
  const char* const known = parameter.prior_sigma                        ? "prior"
                            : parameter.group == ParameterGroup::kEffect ? "usual size"
                                                                         : "tolerance";
  return fmt::format("the readings say less about {} than its {} does", parameter.name, known);
}

/// Why a direction that mixes frames and rows is hidden, or "".
std::string Reason(const RobotModel& robot, const Names& names, const NullDirection& n) {
  bool base = false, tool = false, first = false, last = false;
  for (const NullDirection::Entry& entry : n.direction) {
    const ParameterGroup group = names.at(entry.name).group;
    base |= group == ParameterGroup::kBase;
    tool |= group == ParameterGroup::kTool;
    first |= names.joint(entry.name) == 0;
    last |= names.joint(entry.name) == robot.num_joints() - 1;
  }
  if (base && first && !tool) return ": the base frame and the first DH row act alike";
  if (tool && last && !base) return ": the tool and the last DH row act alike";
  return "";
}

std::string Two(const RobotModel& robot, const Names& names, const NullDirection& n) {
  // The direction (n1, n2) is hidden, so x1 - (n1 / n2) x2 is what the readings see.
  const Parameter& first = names.at(n.direction[0].name);
  const Parameter& second = names.at(n.direction[1].name);
  const double coefficient = -n.direction[0].weight / n.direction[1].weight;
  return "only " + first.name + Term(coefficient, second, first.unit) + " is determined" +
         Reason(robot, names, n);
}

std::string Many(const RobotModel& robot, const Names& names, const NullDirection& n) {
  std::vector<std::string> items;
  for (const NullDirection::Entry& entry : n.direction) {
    if (items.size() == kMostNamed) break;
    items.push_back(entry.name);
  }
  const std::size_t more = n.direction.size() - items.size();
  if (more > 0) items.push_back(fmt::format("{} more", more));
  return Join(items, " and ") + " can change together without changing a reading" +
         Reason(robot, names, n);
}

}  // namespace

void WriteExplanations(const RobotModel& robot,
                       const MeasurementKind& kind,
                       const std::vector<Parameter>& parameters,
                       std::vector<NullDirection>* directions) {
  const Names names(robot, parameters);
  for (NullDirection& n : *directions) {
    if (n.direction.size() == 1) {
      n.explanation = One(robot, kind, names.at(n.direction[0].name));
    } else if (IsParallelOffsets(robot, names, n)) {
      n.explanation = ParallelOffsets(robot, names, n, *directions);
    } else if (n.direction.size() == 2) {
      n.explanation = Two(robot, names, n);
    } else {
      n.explanation = Many(robot, names, n);
    }
  }
}

}  // namespace dhcal
