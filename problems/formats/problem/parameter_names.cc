#include "problems/formats/problem/parameter_names.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/model/joint_numbers.h"

namespace dhcal {

namespace {

struct NamedKind {
  std::string name;
  NameKind kind;
};

const std::vector<NamedKind>& RowGroups() {
  static const std::vector<NamedKind> groups = [] {
    std::vector<NamedKind> all;
    for (const JointNumber& number : kJointNumbers) {
      all.push_back(
          {number.name, number.unit == Unit::kRadian ? NameKind::kAngle : NameKind::kLength});
    }
    return all;
  }();
  return groups;
}

const std::vector<NamedKind>& FrameEntries() {
  static const std::vector<NamedKind> entries = {{"x", NameKind::kLength},
                                                 {"y", NameKind::kLength},
                                                 {"z", NameKind::kLength},
                                                 {"rx", NameKind::kAngle},
                                                 {"ry", NameKind::kAngle},
                                                 {"rz", NameKind::kAngle}};
  return entries;
}

std::vector<std::string> AllNames(const RobotModel& robot) {
  std::vector<std::string> names = {"complete", "base", "tool"};
  for (const NamedKind& group : RowGroups()) {
    names.push_back(group.name);
    for (int i = 1; i <= robot.num_joints(); ++i) names.push_back(group.name + std::to_string(i));
  }
  for (const NamedKind& entry : FrameEntries()) {
    names.push_back("base_" + entry.name);
    names.push_back("tool_" + entry.name);
    for (const Target& target : robot.targets) {
      names.push_back("tool_" + entry.name + "." + target.name);
    }
  }
  return names;
}

/// "theta12" -> 12 after the stem "theta"; nothing when the rest is no number.
std::optional<std::int64_t> NumberAfter(const std::string& name, const std::string& stem) {
  if (!StartsWith(name, stem) || name.size() == stem.size()) return std::nullopt;
  const std::string digits = name.substr(stem.size());
  const bool plain = digits.find_first_not_of("0123456789") == std::string::npos;
  if (!plain || (digits.size() > 1 && digits[0] == '0')) return std::nullopt;
  return ParseInteger(digits);
}

/// "base_rx" -> angle.
std::optional<NameKind> FrameEntryKind(const std::string& stem) {
  for (const NamedKind& entry : FrameEntries()) {
    if (stem == "base_" + entry.name || stem == "tool_" + entry.name) return entry.kind;
  }
  return std::nullopt;
}

/// Why the frame entry cannot belong to `owner`; "" when it can. Whether a run or an edge exists is
/// seen only in the recording.
std::string OwnerProblem(const std::string& stem,
                         const std::string& owner,
                         const RobotModel& robot) {
  if (StartsWith(stem, "base_")) {
    if (robot.base_per_edge) return "";
    return robot.base_per_run ? "" : "names a run, but 'robot.base' has no 'per_run: true'";
  }
  std::vector<std::string> names;
  for (const Target& target : robot.targets) names.push_back(target.name);
  if (robot.tool_per_run || std::find(names.begin(), names.end(), owner) != names.end()) return "";
  if (names.empty()) {
    return "names a target or run, but the robot has no 'targets' and no 'per_run: true' tool";
  }
  return fmt::format("names the unknown target '{}'; the targets are {}",
                     Printable(owner),
                     QuotedList(names, "and"));
}

}  // namespace

std::pair<std::string, std::string> SplitOwner(const std::string& name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return {name, ""};
  return {name.substr(0, dot), name.substr(dot + 1)};
}

std::optional<NameKind> ClassifyParameterName(const std::string& name,
                                              const RobotModel& robot,
                                              std::string* problem) {
  if (name == "base" || name == "tool") return NameKind::kLengthsAndAngles;
  for (const NamedKind& group : RowGroups()) {
    if (name == group.name) return group.kind;
    const std::optional<std::int64_t> joint = NumberAfter(name, group.name);
    if (!joint) continue;
    // A robot whose joints could not be read has its own error already.
    const int num_joints = robot.num_joints();
    if (num_joints == 0 || (*joint >= 1 && *joint <= num_joints)) return group.kind;
    *problem = fmt::format("names joint {}, but the robot has joints 1 to {}", *joint, num_joints);
    return std::nullopt;
  }
  const auto [stem, owner] = SplitOwner(name);
  if (const std::optional<NameKind> kind = FrameEntryKind(stem)) {
    if (stem == name) return kind;
    *problem = OwnerProblem(stem, owner, robot);
    return problem->empty() ? kind : std::nullopt;
  }
  const std::string nearest = NearestName(name, AllNames(robot));
  *problem = "is no parameter of this robot; " +
             (nearest.empty() ? "groups are theta, alpha, a, d, beta, base and tool, single names "
                                "are like theta1, a3, tool_z or base_rx"
                              : "did you mean '" + nearest + "'?");
  return std::nullopt;
}

}  // namespace dhcal
