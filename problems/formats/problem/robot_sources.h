// Rows that a problem file takes from files of others: a URDF, a UR controller's calibration.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_SOURCES_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_SOURCES_H_

#include <optional>

#include <Eigen/Geometry>

#include "core/io/yaml_map.h"
#include "core/model/problem_spec.h"
#include "core/model/robot.h"
#include "problems/formats/problem/path_resolver.h"

namespace dhcal {

/// What stands before the first joint and behind the last one: it becomes part of base and tool.
struct FixedEnds {
  Eigen::Isometry3d before = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d behind = Eigen::Isometry3d::Identity();
  bool any = false;
};

/// `urdf: arm.urdf, base_link: a, tip_link: b`: standard rows, masses and limits. Without joints
/// after an error. Returns base link to B and T to tip link.
FixedEnds ReadUrdfRows(YamlMap* map,
                       const YamlValue& file,
                       const PathResolver& resolve_path,
                       RobotModel* robot,
                       std::optional<UrdfSource>* urdf);

/// `calibration_conf: calibration.conf`: its deltas are added to the rows. True when it is there.
bool ReadUrCalibrationOf(YamlMap* map, const PathResolver& resolve_path, RobotModel* robot);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_SOURCES_H_
