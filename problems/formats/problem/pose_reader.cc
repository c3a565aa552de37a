#include "problems/formats/problem/pose_reader.h"

#include <optional>

#include "core/math/rotation.h"

namespace dhcal {

void ReadVector3(YamlMap* map, const std::string& stem, Eigen::Vector3d* vector) {
  Eigen::VectorXd numbers = *vector;
  map->Read(stem, LengthUnits(), 3, &numbers);
  *vector = numbers;
}

Eigen::Isometry3d ReadPoseKeys(YamlMap* map) {
  Eigen::Vector3d xyz = Eigen::Vector3d::Zero();
  ReadVector3(map, "xyz", &xyz);
  Eigen::VectorXd rpy = Eigen::VectorXd::Zero(3);
  map->Read("rpy", AngleUnits(), 3, &rpy);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = xyz;
  X.linear() = RotationFromRpy(rpy);
  return X;
}

void ReadFrame(const YamlValue& value,
               Eigen::Isometry3d* X,
               bool* per_run,
               std::vector<RunFrame>* of_run) {
  YamlMap map(value);
  *X = ReadPoseKeys(&map);
  map.Read("per_run", per_run);
  const std::optional<YamlValue> runs = map.Find("runs");
  if (!runs) return;
  if (!*per_run) {
    runs->Error("needs 'per_run: true' beside it");
    return;
  }
  YamlMap run_map(*runs);
  for (const auto& [run, run_value] : run_map.AllEntries()) {
    YamlMap pose(run_value);
    of_run->push_back({run, ReadPoseKeys(&pose)});
  }
}

}  // namespace dhcal
