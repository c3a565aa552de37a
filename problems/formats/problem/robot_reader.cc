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
#include "core/kinematics/dh_chain.h"
#include "core/kinematics/dh_rows.h"
#include "core/model/joint_numbers.h"
#include "problems/formats/problem/pose_reader.h"
#include "problems/formats/problem/robot_sources.h"

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
void ReadDhEntry(YamlMap* row, const JointNumber& number, const DhUnits& units, double* entry) {
  constexpr double kUnusualAngle = 4 * kPi;  // [rad]
  constexpr double kUnusualLength = 100;     // [m]
  const bool angle = number.unit == Unit::kRadian;
  const std::optional<UnitValue> found = row->Find(number.name, angle ? units.angle : units.length);
  if (!found) return;
  if (angle) {
    const std::optional<double> read = found->value.Angle(found->to_si);
    if (!read) return;
    *entry = *read;
  } else {
    const std::optional<double> read = found->value.Number();
    if (!read) return;
    *entry = *read * found->to_si;
  }
  if (std::abs(*entry) > (angle ? kUnusualAngle : kUnusualLength)) {
    found->value.Warning(
        fmt::format("is {}, which is unusually large; check its unit", *entry / found->to_si));
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

/// `limits_deg: [-185, 185]`; of a slide `limits_mm`.
void ReadLimits(YamlMap* map, JointRow* row) {
  const UnitSpellings& units = row->type == JointType::kRevolute ? AngleUnits() : LengthUnits();
  const std::optional<UnitValue> value = map->Find("limits", units);
  if (!value) return;
  Eigen::VectorXd limits(2);
  limits << row->lower, row->upper;
  map->Read("limits", units, 2, &limits);
  if (!(limits[0] < limits[1])) {
    value->value.Error("needs the lower limit first, then the larger upper one");
    return;
  }
  row->lower = limits[0];
  row->upper = limits[1];
}

/// A row of `joints`: one that moves, or one that only carries on from there.
struct ReadRow {
  JointRow row;
  bool fixed = false;
};

enum class RowType { kRevolute, kPrismatic, kFixed };

ReadRow ReadJoint(const YamlValue& value, int joint_idx, const DhUnits& units) {
  ReadRow read;
  read.row.name = "J" + std::to_string(joint_idx + 1);
  read.row.where = value.where();
  YamlMap map(value);
  map.Read("name", &read.row.name);
  RowType type = RowType::kRevolute;
  map.ReadChoice<RowType>("type",
                          {{"revolute", RowType::kRevolute},
                           {"prismatic", RowType::kPrismatic},
                           {"fixed", RowType::kFixed}},
                          &type);
  read.fixed = type == RowType::kFixed;
  if (type == RowType::kPrismatic) read.row.type = JointType::kPrismatic;
  for (const JointNumber& number : kJointNumbers) {
    ReadDhEntry(&map, number, units, &(read.row.*number.value));
  }
  if (!read.fixed) {
    ReadSign(&map, &read.row.sign);
    ReadLimits(&map, &read.row);
  }
  return read;
}

/// The pose that a row makes with its joint at zero.
Eigen::Isometry3d PoseOf(const JointRow& row, DhConvention convention) {
  RobotModel robot;
  robot.convention = convention;
  robot.joints = {row};
  return DhChain(robot).LinkFrames(Eigen::VectorXd::Zero(1)).back();
}

FixedEnds ReadJoints(YamlMap* map, const DhUnits& units, RobotModel* robot) {
  FixedEnds ends;
  const std::optional<YamlValue> value = map->Require("joints");
  if (!value) return ends;
  const std::optional<std::vector<YamlValue>> rows = value->List();
  if (!rows) return ends;
  std::map<std::string, int> number_of_name;
  std::optional<YamlValue> fixed_behind;
  for (const YamlValue& item : *rows) {
    const int idx = robot->num_joints();
    const ReadRow read = ReadJoint(item, idx, units);
    if (read.fixed) {
      const Eigen::Isometry3d X = PoseOf(read.row, robot->convention);
      Eigen::Isometry3d* const end = idx == 0 ? &ends.before : &ends.behind;
      *end = *end * X;
      ends.any = true;
      if (idx > 0) fixed_behind = item;
      continue;
    }
    if (fixed_behind) {
      fixed_behind->Error(
          "is a fixed row between joints; put its angles and lengths into the rows beside it "
          "(fixed "
          "rows may stand before the first joint and behind the last one)");
      fixed_behind.reset();
    }
    robot->joints.push_back(read.row);
    const auto [first, is_new] = number_of_name.emplace(robot->joints.back().name, idx + 1);
    if (!is_new) {
      item.Error(fmt::format(
          "has the name '{}' of joint {}; give each joint its own", first->first, first->second));
    }
  }
  if (robot->joints.empty()) {
    value->Error(rows->empty() ? "is an empty list, but a robot has at least one joint"
                               : "has fixed rows only, but a robot has at least one joint");
  }
  return ends;
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

/// Base, tool and payload, with gravity in the base's frame.
void ReadSurroundings(YamlMap* map, RobotModel* robot) {
  if (const std::optional<YamlValue> base = map->Find("base")) {
    ReadFrame(*base, &robot->X_WB, &robot->base_per_run, &robot->base_of_run);
  }
  ReadTargets(map, robot);
  Eigen::VectorXd gravity = robot->gravity_B;
  map->Read("gravity_m_s2", {{"", 1.0}}, 3, &gravity);
  robot->gravity_B = gravity;
  if (const std::optional<YamlValue> payload = map->Find("payload")) {
    robot->payload = ReadMass(*payload);
  }
}

}  // namespace

void ReadRobot(const YamlValue& value,
               const PathResolver& resolve_path,
               RobotModel* robot,
               std::optional<UrdfSource>* urdf) {
  YamlMap map(value);
  robot->where = value.key_where();
  map.Read("name", &robot->name);
  map.ReadChoice<DhConvention>(
      "convention",
      {{"standard", DhConvention::kStandard}, {"modified", DhConvention::kModified}},
      &robot->convention);
  if (const std::optional<YamlValue> file = map.Find("urdf")) {
    const DhConvention convention = robot->convention;
    const FixedEnds ends = ReadUrdfRows(&map, *file, resolve_path, robot, urdf);
    ReadSurroundings(&map, robot);
    FoldIntoEnds(ends.before, ends.behind, robot);
    *robot = InConvention(*robot, convention);
    return;
  }
  const FixedEnds ends = ReadJoints(&map, ReadUnits(&map), robot);
  const bool near = ReadUrCalibrationOf(&map, resolve_path, robot);
  ReadSurroundings(&map, robot);
  ReadLinks(&map, robot);
  if (ends.any) FoldIntoEnds(ends.before, ends.behind, robot);
  if (near) *robot = WithNearNormals(*robot);
}

}  // namespace dhcal
