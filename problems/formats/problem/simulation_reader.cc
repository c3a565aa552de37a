#include "problems/formats/problem/simulation_reader.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/io/yaml_map.h"
#include "core/model/joint_numbers.h"
#include "problems/formats/problem/effects_reader.h"
#include "problems/formats/problem/pose_reader.h"

namespace dhcal {

namespace {

constexpr int kMaxPoses = 10'000'000;

/// Length of a per-joint list; any when the joints could not be read.
int JointListLength(const RobotModel& robot) {
  return robot.num_joints() == 0 ? -1 : robot.num_joints();
}

bool HasPrismaticJoint(const RobotModel& robot) {
  return std::any_of(robot.joints.begin(), robot.joints.end(), [](const JointRow& joint) {
    return joint.type == JointType::kPrismatic;
  });
}

/// Reads joint coordinates: "<stem>_deg" or "_rad" of a robot that only turns, or "<stem>" in SI
/// (rad for a revolute joint, m for a prismatic one) of any. True when they are written.
bool ReadJointList(YamlMap* map,
                   const std::string& stem,
                   const RobotModel& robot,
                   Eigen::VectorXd* list) {
  UnitSpellings units = AngleUnits();
  units.push_back({"", 1.0});
  const std::optional<UnitValue> found = map->Find(stem, units);
  if (!found) return false;
  const bool bare = map->Has(stem);
  if (!bare && HasPrismaticJoint(robot)) {
    found->value.Error(fmt::format(
        "is in angles, but the robot has a prismatic joint; write '{}' in SI units instead: rad "
        "for its revolute joints, m for its prismatic ones",
        stem));
    return true;
  }
  const std::optional<Eigen::VectorXd> numbers = found->value.Numbers(JointListLength(robot));
  if (numbers) *list = *numbers * found->to_si;
  return true;
}

void RequireJointList(YamlMap* map,
                      const std::string& stem,
                      const RobotModel& robot,
                      Eigen::VectorXd* list) {
  const int errors_before = map->value().source()->num_errors();
  const bool written = ReadJointList(map, stem, robot, list);
  const bool silent = map->value().source()->num_errors() == errors_before;
  if (written || !silent) return;
  const bool prismatic = HasPrismaticJoint(robot);
  map->value().source()->Error(map->value().key_where(),
                               fmt::format("{} lacks the key '{}', one number per joint{}",
                                           map->value().QuotedName(),
                                           prismatic ? stem : stem + "_deg",
                                           prismatic ? " in SI units (rad or m)" : ""));
}

void ReadRandomMotion(YamlMap* map, const RobotModel& robot, MotionSpec* motion) {
  motion->lower = Eigen::VectorXd::Constant(robot.num_joints(), -kPi);
  motion->upper = Eigen::VectorXd::Constant(robot.num_joints(), kPi);
  if (HasPrismaticJoint(robot)) {
    // There is no usual range of a slide.
    RequireJointList(map, "min", robot, &motion->lower);
    RequireJointList(map, "max", robot, &motion->upper);
  } else {
    ReadJointList(map, "min", robot, &motion->lower);
    ReadJointList(map, "max", robot, &motion->upper);
  }
  if (motion->lower.size() != motion->upper.size()) return;
  for (Eigen::Index i = 0; i < motion->lower.size(); ++i) {
    if (motion->lower[i] <= motion->upper[i]) continue;
    map->value().Error(fmt::format("has a minimum above its maximum for joint {}", i + 1));
  }
}

void ReadLine(const YamlValue& value, MotionLine* line) {
  YamlMap map(value);
  if (const std::optional<YamlValue> from = map.Require("from")) {
    YamlMap pose(*from);
    line->X_WQ = ReadPoseKeys(&pose);
  }
  if (const std::optional<YamlValue> to = map.Require("to")) {
    YamlMap point(*to);
    ReadVector3(&point, "xyz", &line->p_WQ_end);
  }
}

/// `lines`, or `along_edges` of a kind that reads along edges.
void ReadLines(YamlMap* map, const MeasurementKind& kind, MotionSpec* motion) {
  const std::optional<YamlValue> edges = map->Find("along_edges");
  const std::optional<YamlValue> lines = map->Find("lines");
  if (edges.has_value() == lines.has_value()) {
    map->value().Error(edges ? "has 'lines' beside 'along_edges'; keep one of them"
                             : "needs 'lines: [{from: {xyz_mm, rpy_deg}, to: {xyz_mm}}]', or "
                               "'along_edges: {length_mm, stand_off_mm}' of edges");
    return;
  }
  if (edges) {
    if (!kind.edges) {
      edges->Error("needs a 'measurement.kind' that reads along edges: 'straight_edge'");
    }
    motion->along_edges.emplace();
    YamlMap along(*edges);
    for (const auto& [stem, length] : {std::pair("length", &motion->along_edges->length),
                                       std::pair("stand_off", &motion->along_edges->stand_off)}) {
      if (!along.Find(stem, LengthUnits())) {
        edges->Error(fmt::format("lacks the key '{}_mm'", stem));
      }
      along.Read(stem, LengthUnits(), length, Range::Above(0));
    }
    return;
  }
  const std::optional<std::vector<YamlValue>> items = lines->List();
  if (!items) return;
  if (items->empty()) lines->Error("is an empty list, but at least one line is expected");
  for (const YamlValue& item : *items) ReadLine(item, &motion->lines.emplace_back());
}

void ReadMotion(const YamlValue& value,
                const RobotModel& robot,
                const MeasurementKind& kind,
                const PathResolver& resolve_path,
                MotionSpec* motion) {
  YamlMap map(value);
  const bool kind_known =
      map.RequireKey("kind") && map.ReadChoice<MotionKind>("kind",
                                                           {{"increments", MotionKind::kIncrements},
                                                            {"random", MotionKind::kRandom},
                                                            {"line", MotionKind::kLine},
                                                            {"file", MotionKind::kFile}},
                                                           &motion->kind);
  if (!kind_known) {
    map.AcceptAllKeys();
    return;
  }
  map.set_remark("of this kind");
  if (motion->kind == MotionKind::kFile) {
    if (const std::optional<YamlValue> file = map.Require("file")) {
      motion->file = resolve_path(*file);
    }
    return;
  }
  map.Read("poses", &motion->num_poses, 1, kMaxPoses);
  if (motion->kind == MotionKind::kRandom) return ReadRandomMotion(&map, robot, motion);
  RequireJointList(&map, "home", robot, &motion->home);
  if (motion->kind == MotionKind::kLine) {
    map.Read("tilt", AngleUnits(), &motion->tilt, Range::AtLeast(0));
    return ReadLines(&map, kind, motion);
  }
  RequireJointList(&map, "increments", robot, &motion->increments);
}

/// Errors of base or tool: x y z [m] and a rotation vector [rad].
void ReadFrameErrors(YamlMap* map, const std::string& key, Eigen::VectorXd* errors) {
  const std::optional<YamlValue> value = map->Find(key);
  if (!value) return;
  YamlMap frame(*value);
  Eigen::VectorXd xyz = Eigen::VectorXd::Zero(3);
  Eigen::VectorXd rotation = Eigen::VectorXd::Zero(3);
  frame.Read("xyz", LengthUnits(), 3, &xyz);
  frame.Read("rotvec", SmallAngleUnits(), 3, &rotation);
  errors->resize(6);
  *errors << xyz, rotation;
}

void ReadErrors(const YamlValue& value, const RobotModel& robot, SimulationSpec* simulation) {
  YamlMap map(value);
  const int n = JointListLength(robot);
  for (const JointNumber& number : kJointNumbers) {
    const auto& units = number.unit == Unit::kRadian ? SmallAngleUnits() : LengthUnits();
    map.Read(number.name, units, n, &simulation->row_errors(number.slot));
  }
  ReadFrameErrors(&map, "base", &simulation->base);
  ReadFrameErrors(&map, "tool", &simulation->tool);
}

}  // namespace

void ReadSimulation(const YamlValue& value,
                    const RobotModel& robot,
                    const MeasurementKind& kind,
                    const PathResolver& resolve_path,
                    SimulationSpec* simulation) {
  YamlMap map(value);
  if (const std::optional<YamlValue> motion = map.Require("motion")) {
    ReadMotion(*motion, robot, kind, resolve_path, &simulation->motion);
  }
  if (const std::optional<YamlValue> errors = map.Find("errors")) {
    ReadErrors(*errors, robot, simulation);
  }
  ReadEffects(&map, robot, /*with_values=*/true, &simulation->effects);
  map.Read("noise", LengthUnits(), &simulation->noise, Range::AtLeast(0));
  map.Read("noise_rotation", SmallAngleUnits(), &simulation->noise_rotation, Range::AtLeast(0));
  if (simulation->noise_rotation > 0 && !kind.sees_orientation()) {
    map.Find("noise_rotation", SmallAngleUnits())
        ->value.Error("applies to 'measurement.kind: pose' only; remove it");
  }
  if (const std::optional<YamlValue> seed = map.Find("seed")) {
    if (const std::optional<std::uint64_t> number = seed->Unsigned()) simulation->seed = *number;
  }
}

}  // namespace dhcal
