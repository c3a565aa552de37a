// The parts of a robot as nodes of YAML, as problem files have them.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_NODES_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_NODES_H_

#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <yaml-cpp/yaml.h>

#include "core/model/robot.h"

namespace dhcal {

/// The shortest digits that read back as the same double.
std::string Digits(double value);

YAML::Node FlowMap();
YAML::Node FlowList(const Eigen::Vector3d& numbers);

/// Null when the key is missing, which reads better than the library's invalid node.
YAML::Node Child(const YAML::Node& map, const std::string& key);

/// A map's entries whose key, without its unit suffix, is none of these.
YAML::Node Without(const std::vector<std::string>& stems, const YAML::Node& map);

/// A row's numbers in place of those that `old` has; its other keys stay.
YAML::Node JointNode(const JointRow& joint, const YAML::Node& old);
/// All that there is to say of a row.
YAML::Node NewJointNode(const JointRow& joint);

/// Sets `xyz_m` and `rpy_deg`.
void SetPose(const Eigen::Isometry3d& X, YAML::Node* node);
/// `base` or `tool`; the other keys of `old` stay.
YAML::Node FrameNode(const Eigen::Isometry3d& X,
                     const std::vector<RunFrame>& frames_of_runs,
                     const YAML::Node& old);
YAML::Node TargetsNode(const std::vector<Target>& targets, const YAML::Node& old);

YAML::Node MassNode(const LinkMass& link);
YAML::Node LinksNode(const std::vector<LinkMass>& links);

/// A robot from the rows on: convention, joints, base, tool or targets, gravity, links, payload.
/// Keys of `old` that say other things (name, per_run) stay; what a file of other rows says (urdf,
/// units) goes.
YAML::Node NewRobotNode(const RobotModel& robot, const YAML::Node& old);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_ROBOT_NODES_H_
