#include "problems/formats/problem/robot_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/io/yaml_map.h"
#include "core/model/joint_numbers.h"
#include "problems/formats/problem/pose_reader.h"

namespace dhcal {

namespace {

/// The spellings of DH entries; keys without a unit have the units that `robot.units` states.
struct DhUnits {
  UnitSpellings angle = AngleUnits();
  UnitSpellings length = LengthUnits();
};

DhUnits ReadUnits(YamlMap* map) {
  double angle = kDegree;
  double length = 1.0;
  if (const std::optional<YamlValue> value = map->Find("units")) {
    YamlMap units(*value);
    units.ReadChoice<double>("angle", {{"deg", kDegree}, {"rad", 1.0}}, &angle);
    units.ReadChoice<double>("length", {{"m", 1.0}, {"mm", kMillimetre}}, &length);
  }
  DhUnits dh_units;
  dh_units.angle.push_back({"", angle});
  dh_units.length.push_back({"", length});
  return dh_units;
}

/// Reads one DH entry [rad] or [m]. A size that no robot has is most often a unit mistaken.
void ReadDhEntry(YamlMap* row,
                 const std::string& stem,
                 const UnitSpellings& units,
                 double unusual,
                 double* entry) {
  const std::optional<UnitValue> found = row->Find(stem, units);
  if (!found) return;
  const std::optional<double> number = found->value.Number();
  if (!number) return;
  *entry = *number * found->to_si;
  if (std::abs(*entry) > unusual) {
    found->value.Warning(fmt::format("is {}, which is unusually large; check its unit", *number));
  }
}

void ReadSign(YamlMap* row, double* sign) {
  const std::optional<YamlValue> value = row->Find("sign");
  if (!value) return;
  const std::optional<double> number = value->Number();
  if (!number) return;
  if (std::abs(*number) == 1.0) {
    *sign = *number;
  } else {
    value->Error(fmt::format("is {}, but 1 or -1 is expected", *number));
  }
}

JointRow ReadJoint(const YamlValue& value, int joint_idx, const DhUnits& units) {
  constexpr double kUnusualAngle = 4 * kPi;  // [rad]
  constexpr double kUnusualLength = 100;     // [m]
  JointRow row;
  row.name = "J" + std::to_string(joint_idx + 1);
  row.where = value.where();
  YamlMap map(value);
  map.Read("name", &row.name);
  map.ReadChoice<JointType>(
      "type",
      {{"revolute", JointType::kRevolute}, {"prismatic", JointType::kPrismatic}},
      &row.type);
  for (const JointNumber& number : kJointNumbers) {
    const bool angle = number.unit == Unit::kRadian;
    ReadDhEntry(&map,
                number.name,
                angle ? units.angle : units.length,
                angle ? kUnusualAngle : kUnusualLength,
                &(row.*number.value));
  }
  ReadSign(&map, &row.sign);
  return row;
}

void ReadJoints(YamlMap* map, const DhUnits& units, RobotModel* robot) {
  const std::optional<YamlValue> value = map->Require("joints");
  if (!value) return;
  const std::optional<std::vector<YamlValue>> rows = value->List();
  if (!rows) return;
  if (rows->empty()) value->Error("is an empty list, but a robot has at least one joint");
  std::map<std::string, int> number_of_name;
  for (const YamlValue& row : *rows) {
    const int idx = robot->num_joints();
    robot->joints.push_back(ReadJoint(row, idx, units));
    const auto [first, is_new] = number_of_name.emplace(robot->joints.back().name, idx + 1);
    if (!is_new) {
      row.Error(fmt::format(
          "has the name '{}' of joint {}; give each joint its own", first->first, first->second));
    }
  }
}

void ReadTargets(YamlMap* map, RobotModel* robot) {
  const std::optional<YamlValue> tool = map->Find("tool");
  const std::optional<YamlValue> targets = map->Find("targets");
  if (tool) ReadFrame(*tool, &robot->X_TQ, &robot->tool_per_run, &robot->tool_of_run);
  if (!targets) return;
  if (tool) targets->Error("stands beside 'robot.tool'; give one of them");
  YamlMap target_map(*targets);
  const auto entries = target_map.AllEntries();
  if (target_map.valid() && entries.empty()) targets->Error("names no target");
  for (const auto& [name, pose_value] : entries) {
    YamlMap pose(pose_value);
    robot->targets.push_back({name, ReadPoseKeys(&pose)});
  }
}

LinkMass ReadMass(const YamlValue& value) {
  LinkMass link;
  YamlMap map(value);
  map.Read("mass_kg", &link.mass, Range::AtLeast(0));
  ReadVector3(&map, "com", &link.p_LC);
  return link;
}

void ReadLinks(YamlMap* map, RobotModel* robot) {
  const std::optional<YamlValue> value = map->Find("links");
  if (!value) return;
  const std::optional<std::vector<YamlValue>> links = value->List();
  if (!links || links->empty()) return;
  for (const YamlValue& link : *links) robot->links.push_back(ReadMass(link));
  const int expected = robot->num_joints();
  if (expected > 0 && static_cast<int>(links->size()) != expected) {
    value->Error(fmt::format("has {} entries, but the robot has {} joints; give one per joint",
                             links->size(),
                             expected));
  }
}

}  // namespace

void ReadRobot(const YamlValue& value, RobotModel* robot) {
  YamlMap map(value);
  robot->where = value.key_where();
  map.Read("name", &robot->name);
  map.ReadChoice<DhConvention>(
      "convention",
      {{"standard", DhConvention::kStandard}, {"modified", DhConvention::kModified}},
      &robot->convention);
  ReadJoints(&map, ReadUnits(&map), robot);
  if (const std::optional<YamlValue> base = map.Find("base")) {
    ReadFrame(*base, &robot->X_WB, &robot->base_per_run, &robot->base_of_run);
  }
  ReadTargets(&map, robot);
  Eigen::VectorXd gravity = robot->gravity_B;
  map.Read("gravity_m_s2", {{"", 1.0}}, 3, &gravity);
  robot->gravity_B = gravity;
  ReadLinks(&map, robot);
  if (const std::optional<YamlValue> payload = map.Find("payload")) {
    robot->payload = ReadMass(*payload);
  }
}

}  // namespace dhcal
