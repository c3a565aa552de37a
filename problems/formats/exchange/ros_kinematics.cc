#include "problems/formats/exchange/ros_kinematics.h"

#include <array>
#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/io/text_file.h"
#include "core/io/yaml_map.h"
#include "core/io/yaml_source.h"
#include "core/kinematics/dh_chain.h"
#include "core/kinematics/dh_rows.h"
#include "core/math/rotation.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;

struct UrLink {
  const char* link;
  const char* joint;
};

constexpr std::array<UrLink, 6> kUrLinks = {UrLink{"shoulder", "shoulder_pan_joint"},
                                            UrLink{"upper_arm", "shoulder_lift_joint"},
                                            UrLink{"forearm", "elbow_joint"},
                                            UrLink{"wrist_1", "wrist_1_joint"},
                                            UrLink{"wrist_2", "wrist_2_joint"},
                                            UrLink{"wrist_3", "wrist_3_joint"}};

Isometry3d ReadOrigin(const YamlValue& value) {
  YamlMap map(value);
  Eigen::Vector3d xyz = Eigen::Vector3d::Zero(), rpy = Eigen::Vector3d::Zero();
  const std::array<const char*, 3> lengths = {"x", "y", "z"};
  const std::array<const char*, 3> angles = {"roll", "pitch", "yaw"};
  for (int k = 0; k < 3; ++k) {
    const auto idx = static_cast<std::size_t>(k);
    if (map.RequireKey(lengths[idx])) map.Read(lengths[idx], &xyz[k]);
    if (map.RequireKey(angles[idx])) map.Read(angles[idx], &rpy[k]);
  }
  Isometry3d X = Isometry3d::Identity();
  X.translation() = xyz;
  X.linear() = RotationFromRpy(rpy);
  return X;
}

void ReadKinematics(const YamlValue& root, RosKinematics* kinematics) {
  YamlMap file(root);
  const auto value = file.Require("kinematics");
  if (!value) return;
  YamlMap map(*value);
  for (const UrLink& link : kUrLinks) {
    if (const auto origin = map.Require(link.link)) {
      kinematics->origins.push_back(ReadOrigin(*origin));
    }
  }
  map.Read("hash", &kinematics->hash);
}

}  // namespace

std::optional<RosKinematics> ReadRosKinematics(const std::string& file, Diagnostics* diagnostics) {
  std::optional<std::string> text = ReadTextFile(file, diagnostics);
  if (!text) return std::nullopt;
  Diagnostics found;
  RosKinematics kinematics;
  const YamlSource source(file, std::move(*text), &found);
  if (const std::optional<YAML::Node> root = source.Parse()) {
    ReadKinematics(YamlValue(*root, "", {file, 1, 1}, &source), &kinematics);
  }
  for (const Diagnostic& message : found.all()) diagnostics->Add(message);
  return found.ok() ? std::optional(kinematics) : std::nullopt;
}

std::string RosKinematicsText(const RosKinematics& kinematics) {
  std::string text = "kinematics:\n";
  for (std::size_t k = 0; k < kUrLinks.size(); ++k) {
    const Eigen::Vector3d p = kinematics.origins[k].translation();
    const Eigen::Vector3d rpy = RpyFromRotation(kinematics.origins[k].linear());
    // + 0.0: no "-0"
    text += fmt::format(
        "  {}:\n    x: {}\n    y: {}\n    z: {}\n    roll: {}\n    pitch: {}\n    yaw: {}\n",
        kUrLinks[k].link,
        p.x() + 0.0,
        p.y() + 0.0,
        p.z() + 0.0,
        rpy.x() + 0.0,
        rpy.y() + 0.0,
        rpy.z() + 0.0);
  }
  return text + "  hash: " + kinematics.hash + "\n";
}

RobotModel RobotOfRosKinematics(const RosKinematics& kinematics) {
  std::vector<JointAxis> axes;
  Isometry3d X_BC = Isometry3d::Identity();
  for (const Isometry3d& origin : kinematics.origins) {
    X_BC = X_BC * origin;
    axes.push_back({JointType::kRevolute, X_BC.translation(), X_BC.linear().col(2)});
  }
  const RowsOfAxes rows = StandardRows(axes, X_BC);
  RobotModel robot;
  robot.name = "ur";
  robot.joints = rows.rows;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) robot.joints[j].name = kUrLinks[j].joint;
  FoldIntoEnds(rows.X_AB, rows.X_TE, &robot);
  return robot;
}

std::vector<Isometry3d> OriginsOfRows(const RobotModel& robot) {
  const std::vector<Isometry3d> X_BL = DhChain(InConvention(robot, DhConvention::kModified))
                                           .LinkFrames(Eigen::VectorXd::Zero(robot.num_joints()));
  std::vector<Isometry3d> origins;
  for (std::size_t j = 1; j < X_BL.size(); ++j) {
    origins.push_back(X_BL[j - 1].inverse() * X_BL[j]);
  }
  return origins;
}

}  // namespace dhcal
