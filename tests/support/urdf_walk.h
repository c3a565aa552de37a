// A walk through a URDF written apart from the product: its own reading of the text, plain 4 x 4
// matrices, and rotations from sines and from the exponential series.
#ifndef DHCAL_TESTS_SUPPORT_URDF_WALK_H_
#define DHCAL_TESTS_SUPPORT_URDF_WALK_H_

#include <cmath>
#include <cstddef>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "tests/support/independent_kinematics.h"

namespace dhcal {

class UrdfWalk {
 public:
  using Coordinates = std::map<std::string, double>;  // of joints by name [rad] or [m]

  explicit UrdfWalk(const std::string& text) {
    const std::string plain = WithoutComments(text);
    for (std::size_t k = plain.find("<joint "); k != std::string::npos;) {
      const std::size_t head = plain.find('>', k), end = plain.find("</joint>", k);
      if (end == std::string::npos) break;
      Add(plain.substr(k, head - k), plain.substr(head, end - head));
      k = plain.find("<joint ", end);
    }
  }

  /// Pose of link `tip` in link `base`, which is above it.
  Eigen::Matrix4d Pose(const std::string& base,
                       const std::string& tip,
                       const Coordinates& q) const {
    if (base == tip) return Eigen::Matrix4d::Identity();
    const auto found = joint_above_.find(tip);
    if (found == joint_above_.end()) throw std::runtime_error("no joint above " + tip);
    const Joint& joint = found->second;
    const auto moved = q.find(joint.name);
    const double by = moved == q.end() ? 0 : moved->second;
    return Pose(base, joint.parent, q) * joint.origin * Motion(joint, by);
  }

 private:
  static std::string WithoutComments(std::string text) {
    for (std::size_t k = text.find("<!--"); k != std::string::npos; k = text.find("<!--")) {
      text.erase(k, text.find("-->", k) + 3 - k);
    }
    return text;
  }

  struct Joint {
    std::string name, type, parent;
    Eigen::Matrix4d origin = Eigen::Matrix4d::Identity();
    Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  };

  static std::string Attribute(const std::string& text, const std::string& name) {
    std::smatch match;
    const std::regex pattern("\\b" + name + "\\s*=\\s*[\"']([^\"']*)[\"']");
    return std::regex_search(text, match, pattern) ? match[1].str() : "";
  }
  static std::string Tag(const std::string& body, const std::string& name) {
    std::smatch match;
    return std::regex_search(body, match, std::regex("<" + name + "\\b[^>]*>")) ? match[0].str()
                                                                                : "";
  }
  static Eigen::Vector3d Three(const std::string& text) {
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    stream >> v[0] >> v[1] >> v[2];
    return v;
  }
  static Eigen::Matrix4d Turn(int i, int j, double angle) {
    Eigen::Matrix4d R = Eigen::Matrix4d::Identity();
    R(i, i) = R(j, j) = std::cos(angle);
    R(j, i) = std::sin(angle);
    R(i, j) = -std::sin(angle);
    return R;
  }
  static Eigen::Matrix4d Motion(const Joint& joint, double q) {
    Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
    const Eigen::Vector3d by = joint.axis / joint.axis.norm() * q;
    if (joint.type == "prismatic") X.topRightCorner<3, 1>() = by;
    if (joint.type == "revolute" || joint.type == "continuous") {
      X.topLeftCorner<3, 3>() = independent::RotationOf<double>(by[0], by[1], by[2]);
    }
    return X;
  }

  void Add(const std::string& head, const std::string& body) {
    Joint joint;
    joint.name = Attribute(head, "name");
    joint.type = Attribute(head, "type");
    joint.parent = Attribute(Tag(body, "parent"), "link");
    const std::string origin = Tag(body, "origin"), axis = Tag(body, "axis");
    const Eigen::Vector3d rpy = Three(Attribute(origin, "rpy"));
    joint.origin = Turn(0, 1, rpy[2]) * Turn(2, 0, rpy[1]) * Turn(1, 2, rpy[0]);
    joint.origin.topRightCorner<3, 1>() = Three(Attribute(origin, "xyz"));
    if (!axis.empty()) joint.axis = Three(Attribute(axis, "xyz"));
    joint_above_[Attribute(Tag(body, "child"), "link")] = joint;
  }

  std::map<std::string, Joint> joint_above_;  // by the link below it
};

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_URDF_WALK_H_
