#include "problems/formats/problem/task_reader.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/io/yaml_map.h"
#include "problems/formats/recording/recording_reader.h"

namespace dhcal {
namespace {

/// Two opposite corners, in any order.
void ReadBox(const UnitValue& box, TaskSpec* task) {
  const std::optional<std::vector<YamlValue>> corners = box.value.List();
  if (!corners) return;
  if (corners->size() != 2) {
    box.value.Error(
        fmt::format("has {} entries, but two opposite corners are expected: "
                    "[[0.8, -0.3, 0.2], [1.2, 0.3, 0.8]]",
                    corners->size()));
    return;
  }
  const std::optional<Eigen::VectorXd> a = (*corners)[0].Numbers(3), b = (*corners)[1].Numbers(3);
  if (!a || !b) return;
  const Eigen::Vector3d low = a->cwiseMin(*b), high = a->cwiseMax(*b);
  if (!((high - low).minCoeff() > 0)) {
    box.value.Error("is flat: its corners need to differ along each of x, y and z");
    return;
  }
  task->box = TaskBox{low * box.to_si, high * box.to_si};
}

/// Random poses need to know how far a joint goes.
void CheckSlidesAreLimited(const YamlValue& value, const RobotModel& robot) {
  for (const JointRow& joint : robot.joints) {
    if (joint.type == JointType::kRevolute || std::isfinite(joint.upper - joint.lower)) continue;
    value.source()->Error(joint.where,
                          fmt::format("joint {} slides, and 'task.box' needs to know how far: add "
                                      "'limits_mm: [0, 800]' to its row",
                                      joint.name));
  }
}

void ReadPosesOf(const YamlValue& value,
                 const std::string& file,
                 const RobotModel& robot,
                 TaskSpec* task) {
  if (file.empty()) return;
  Diagnostics found;
  const std::optional<Recording> rows = ReadRecording(file, robot.joints, &found);
  if (rows && found.ok()) {
    task->q = rows->q;
    task->file = file;
    return;
  }
  for (const Diagnostic& diagnostic : found.all()) {
    if (diagnostic.severity == Severity::kError) {
      value.source()->Error(diagnostic.where, diagnostic.message);
    }
  }
}

}  // namespace

void ReadTask(const YamlValue& value,
              const RobotModel& robot,
              const PathResolver& resolve_path,
              TaskSpec* task) {
  task->where = value.key_where();
  YamlMap map(value);
  if (!map.valid()) return;
  const std::optional<UnitValue> box = map.Find("box", LengthUnits());
  const std::optional<YamlValue> poses = map.Find("poses");
  if (box && poses) {
    poses->Error("stands beside a box; keep one of them");
  } else if (box) {
    ReadBox(*box, task);
    CheckSlidesAreLimited(box->value, robot);
  } else if (poses) {
    ReadPosesOf(*poses, resolve_path(*poses), robot, task);
  } else {
    value.Error("needs 'box_m' (two corners in the robot's base) or 'poses' (a file)");
  }
}

}  // namespace dhcal
