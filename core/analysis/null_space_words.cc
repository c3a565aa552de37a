#include "core/analysis/null_space_words.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>
#include <glog/logging.h>

#include "core/analysis/null_space.h"
#include "core/kinematics/slots.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostNamed = 8;

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
    return slots_.is_joint(slot) ? slot / SlotLayout::kPerJoint : -1;
  }
  bool is_frame(const std::string& name) const { return joint(name) < 0; }

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

std::string One(const Names& names, MeasurementKind kind, const std::string& name) {
  const Parameter& parameter = names.at(name);
  if (parameter.group == ParameterGroup::kEffect) return name + " changes no reading";
  if (parameter.unit == Unit::kRadian) {
    if (parameter.group == ParameterGroup::kTool) {
      return name +
             " turns the tool about the measured point: only a measured orientation shows it";
    }
    if (kind == MeasurementKind::kPose) return name + " changes no reading";
    return name + " turns about an axis through the measured point: no reading depends on it";
  }
  if (kind == MeasurementKind::kAdjacentPosition) {
    return name + " shifts all measured points alike: differences of readings do not show it";
  }
  return name + " does not move the measured point";
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
                       MeasurementKind kind,
                       const std::vector<Parameter>& parameters,
                       std::vector<NullDirection>* directions) {
  const Names names(robot, parameters);
  for (NullDirection& n : *directions) {
    if (n.direction.size() == 1) {
      n.explanation = One(names, kind, n.direction[0].name);
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
