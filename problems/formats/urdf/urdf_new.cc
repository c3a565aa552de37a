#include "problems/formats/urdf/urdf_new.h"

#include <cmath>
#include <cstddef>
#include <set>

#include <fmt/format.h>

#include "core/kinematics/dh_chain.h"
#include "core/kinematics/dh_rows.h"
#include "problems/formats/urdf/urdf_corrected.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string LinkText(const std::string& name, const LinkMass& inertial) {
  if (!(inertial.mass > 0)) return fmt::format("  <link name=\"{}\"/>\n", Escaped(name));
  return fmt::format(
      "  <link name=\"{}\">\n    <inertial>\n      <origin xyz=\"{} {} {}\"/>\n"
      "      <mass value=\"{}\"/>\n"
      "      <inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/>\n"
      "    </inertial>\n  </link>\n",
      Escaped(name),
      inertial.p_LC.x(),
      inertial.p_LC.y(),
      inertial.p_LC.z(),
      inertial.mass);
}

std::string JointHead(const std::string& name,
                      const std::string& type,
                      const std::string& parent,
                      const std::string& child) {
  return fmt::format(
      "  <joint name=\"{}\" type=\"{}\">\n    <parent link=\"{}\"/>\n    <child link=\"{}\"/>\n",
      Escaped(name),
      type,
      Escaped(parent),
      Escaped(child));
}

/// A link fixed to another.
std::string FixedText(const std::string& parent, const std::string& child, const Isometry3d& X) {
  return LinkText(child, {}) + JointHead(parent + "-" + child, "fixed", parent, child) +
         fmt::format("    <origin {}/>\n  </joint>\n", XyzRpyAttributes(X));
}

/// A URDF asks for limits where a joint is not continuous; a slide without them gets a kilometre.
std::string LimitText(const JointRow& row) {
  constexpr double kEndless = 1000;  // [m]
  const bool bounded = std::isfinite(row.lower) && std::isfinite(row.upper);
  if (row.type == JointType::kRevolute && !bounded) return "";
  return fmt::format("    <limit lower=\"{}\" upper=\"{}\" effort=\"0\" velocity=\"0\"/>\n",
                     bounded ? row.lower : -kEndless,
                     bounded ? row.upper : kEndless);
}

std::string MovingText(const JointRow& row,
                       const std::string& parent,
                       const std::string& child,
                       const Isometry3d& X_PC) {
  const std::string limit = LimitText(row);
  const std::string type = row.type == JointType::kPrismatic ? "prismatic"
                           : limit.empty()                   ? "continuous"
                                                             : "revolute";
  return JointHead(row.name, type, parent, child) +
         fmt::format("    <origin {}/>\n    <axis xyz=\"0 0 {}\"/>\n{}  </joint>\n",
                     XyzRpyAttributes(X_PC),
                     row.sign,
                     limit);
}

/// `name`, or with underscores behind it where it is taken.
std::string NewName(std::string name, std::set<std::string>* taken) {
  while (!taken->insert(name).second) name += "_";
  return name;
}

void AddLosses(const RobotModel& robot, std::vector<std::string>* remarks) {
  if (!robot.base_of_run.empty()) {
    remarks->push_back("The robot has a base of its own in each run; they are not in this file.");
  }
  if (!robot.tool_of_run.empty()) {
    remarks->push_back("The robot has a tool of its own in each run; they are not in this file.");
  }
  if (!robot.links.empty()) {
    remarks->push_back("Masses and their centres are known, inertia tensors are not: zero here.");
  }
  for (const JointRow& row : robot.joints) {
    if (row.type == JointType::kPrismatic && !std::isfinite(row.lower)) {
      remarks->push_back("Limits of " + row.name + " are not known; 1 km stands for none.");
    }
  }
}

}  // namespace

std::string UrdfOfRobot(const RobotModel& robot, std::vector<std::string> remarks) {
  const RobotModel modified = InConvention(robot, DhConvention::kModified);
  AddLosses(robot, &remarks);
  const std::string name = robot.name.empty() ? "robot" : robot.name;
  std::string text = "<?xml version=\"1.0\"?>\n" + XmlComment(remarks) +
                     fmt::format("<robot name=\"{}\">\n", Escaped(name));
  std::set<std::string> taken;
  std::string link = "base_link";
  if (!modified.X_WB.isApprox(Isometry3d::Identity(), 0)) {
    text += LinkText(NewName("world", &taken), {});
    text += FixedText("world", NewName(link, &taken), modified.X_WB);
  } else {
    text += LinkText(NewName(link, &taken), {});
  }
  const std::vector<Isometry3d> X_BL =
      DhChain(modified).LinkFrames(Eigen::VectorXd::Zero(modified.num_joints()));
  for (std::size_t j = 0; j < modified.joints.size(); ++j) {
    const std::string child = NewName(fmt::format("link_{}", j + 1), &taken);
    text += LinkText(child, j < modified.links.size() ? modified.links[j] : LinkMass());
    text += MovingText(modified.joints[j], link, child, X_BL[j].inverse() * X_BL[j + 1]);
    link = child;
  }
  for (const Target& target : modified.targets) {
    text += FixedText(link, NewName(target.name, &taken), target.X_TQ);
  }
  if (modified.targets.empty()) text += FixedText(link, NewName("tool0", &taken), modified.X_TQ);
  return text + "</robot>\n";
}

}  // namespace dhcal
