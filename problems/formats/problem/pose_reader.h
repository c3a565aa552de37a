// Reads the rigid poses of a problem file: {xyz_m: [x, y, z], rpy_deg: [roll, pitch, yaw]}.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_POSE_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_POSE_READER_H_

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/io/yaml_map.h"
#include "core/io/yaml_value.h"
#include "core/model/robot.h"

namespace dhcal {

/// Reads the keys `xyz_*` and `rpy_*` of a map: turns about the fixed axes x, y, z in this order,
/// R = Rz(yaw) Ry(pitch) Rx(roll). What is absent is zero.
Eigen::Isometry3d ReadPoseKeys(YamlMap* map);

/// Reads a length-3 vector in metres from `<stem>_m` or `<stem>_mm`.
void ReadVector3(YamlMap* map, const std::string& stem, Eigen::Vector3d* vector);

/// Reads `base` or `tool`: the pose, and `per_run` with `runs: {<run>: {xyz_m, rpy_deg}}`.
void ReadFrame(const YamlValue& value,
               Eigen::Isometry3d* X,
               bool* per_run,
               std::vector<RunFrame>* of_run);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_POSE_READER_H_
