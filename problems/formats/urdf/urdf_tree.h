// A robot description of ROS (URDF) as plain data: links, joints, and where they stand in the file.
#ifndef DHCAL_PROBLEMS_FORMATS_URDF_URDF_TREE_H_
#define DHCAL_PROBLEMS_FORMATS_URDF_URDF_TREE_H_

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/diagnostics.h"
#include "core/model/robot.h"

namespace dhcal {

enum class UrdfJointType { kRevolute, kContinuous, kPrismatic, kFixed, kFloating, kPlanar };

struct UrdfJoint {
  std::string name;
  UrdfJointType type = UrdfJointType::kFixed;
  std::string parent, child;                                // links
  Eigen::Isometry3d X_PC = Eigen::Isometry3d::Identity();   // <origin>: parent to child, at zero
  Eigen::Vector3d axis_C = Eigen::Vector3d::UnitX();        // unit vector
  double lower = -std::numeric_limits<double>::infinity();  // [rad] or [m]; infinite: no limit
  double upper = std::numeric_limits<double>::infinity();
  std::string mimics;  // the joint that it follows, or ""
  SourceLocation where;

  bool moves() const { return type != UrdfJointType::kFixed; }
};

struct UrdfLink {
  std::string parent_joint;               // "" of the root
  std::vector<std::string> child_joints;  // as the file orders them
  LinkMass inertial;                      // in the link's frame; mass 0 where the file has none
};

struct UrdfTree {
  std::string file;
  std::string text;  // of the file, for corrections to be written into
  std::string name;
  std::string root;
  std::map<std::string, UrdfJoint> joints;
  std::map<std::string, UrdfLink> links;
};

/// The tree of a file's text, as urdfdom (the parser of ROS) understands it; nothing after an
/// error.
std::optional<UrdfTree> ParseUrdf(const std::string& file,
                                  const std::string& text,
                                  Diagnostics* diagnostics);

/// The same from a file.
std::optional<UrdfTree> ReadUrdf(const std::string& file, Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_URDF_URDF_TREE_H_
