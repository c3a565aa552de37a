#include "tests/support/urdf_robots.h"

#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace dhcal {
namespace {

constexpr char kHalfPi[] = "1.5707963267948966";

struct JointText {
  std::string name, type, parent, child, origin, axis;  // origin and axis: attributes or ""
};

std::string Text(const JointText& joint) {
  std::string text = fmt::format(
      "  <joint name=\"{}\" type=\"{}\">\n    <parent link=\"{}\"/>\n    <child link=\"{}\"/>\n",
      joint.name,
      joint.type,
      joint.parent,
      joint.child);
  if (!joint.origin.empty()) text += "    <origin " + joint.origin + "/>\n";
  if (!joint.axis.empty()) text += "    <axis xyz=\"" + joint.axis + "\"/>\n";
  if (joint.type == "revolute" || joint.type == "prismatic") {
    text += "    <limit lower=\"-2.5\" upper=\"2.75\" effort=\"330\" velocity=\"2.16\"/>\n";
  }
  return text + "  </joint>\n";
}

/// Each link with a mesh that does not stand in its origin, and a mass.
std::string LinkText(const std::string& name, int number) {
  return fmt::format(
      "  <link name=\"{0}\">\n    <visual>\n      <origin rpy='0  0 {1}' xyz = \"0.01 .2 -{1}\" "
      "/>\n"
      "      <geometry>\n        <mesh filename=\"package://{0}.dae\"/>\n      </geometry>\n"
      "    </visual>\n    <inertial>\n      <mass value=\"{2}\"/>\n"
      "      <origin rpy=\"0 0 0\" xyz=\"0.0{1} 0.02 -0.1\"/>\n"
      "      <inertia ixx=\"0.03\" ixy=\"0\" ixz=\"0\" iyy=\"0.03\" iyz=\"0\" izz=\"0.02\"/>\n"
      "    </inertial>\n  </link>\n",
      name,
      number,
      1.5 + number);
}

std::string RobotText(const std::string& name, const std::vector<JointText>& joints) {
  std::string text = "<?xml version=\"1.0\" ?>\n";
  text += "<!-- written by hand: <joint name=\"none\"> -->\n<robot name=\"" + name + "\">\n";
  std::set<std::string> done;
  int number = 0;
  for (const JointText& joint : joints) {
    for (const std::string& link : {joint.parent, joint.child}) {
      if (done.insert(link).second) text += LinkText(link, ++number);
    }
    text += Text(joint);
  }
  return text +
         "  <transmission name=\"t\">\n    <joint name=\"not_this\"><origin xyz=\"9 9 "
         "9\"/></joint>\n"
         "  </transmission>\n</robot>\n";
}

UrdfRobot Made(const std::string& name, const std::vector<JointText>& joints, std::string tip) {
  UrdfRobot robot;
  robot.name = name;
  robot.base_link = joints.front().parent;
  robot.tip_link = std::move(tip);
  for (const JointText& joint : joints) {
    if (joint.type != "fixed" && joint.name.find("finger") == std::string::npos) {
      robot.joints.push_back(joint.name);
    }
  }
  robot.text = RobotText(name, joints);
  return robot;
}

std::string Rpy(const std::string& xyz, const std::string& rpy) {
  return fmt::format("xyz=\"{}\" rpy=\"{}\"", xyz, rpy);
}

UrdfRobot Ur10Urdf() {
  const std::string h = kHalfPi;
  const std::string pi = "3.141592653589793";
  return Made("ur10",
              {{"base_link-base_link_inertia",
                "fixed",
                "base_link",
                "base_link_inertia",
                Rpy("0 0 0", "0 0 " + pi),
                ""},
               {"shoulder_pan_joint",
                "revolute",
                "base_link_inertia",
                "shoulder_link",
                Rpy("0 0 0.1273", "0 0 0"),
                "0 0 1"},
               {"shoulder_lift_joint",
                "revolute",
                "shoulder_link",
                "upper_arm_link",
                Rpy("0 0 0", "1.570796327 0 0"),
                "0 0 1"},
               {"elbow_joint",
                "revolute",
                "upper_arm_link",
                "forearm_link",
                Rpy("-0.612 0 0", "0 0 0"),
                "0 0 1"},
               {"wrist_1_joint",
                "revolute",
                "forearm_link",
                "wrist_1_link",
                Rpy("-0.5723 0 0.163941", "0 0 0"),
                "0 0 1"},
               {"wrist_2_joint",
                "revolute",
                "wrist_1_link",
                "wrist_2_link",
                Rpy("0 -0.1157 -2.373046667922381e-11", "1.570796327 0 0"),
                "0 0 1"},
               {"wrist_3_joint",
                "revolute",
                "wrist_2_link",
                "wrist_3_link",
                Rpy("0 0.0922 -1.891053610911353e-11", h + " " + pi + " " + pi),
                "0 0 1"},
               {"wrist_3-flange",
                "fixed",
                "wrist_3_link",
                "flange",
                Rpy("0 0 0", "0 -" + h + " -" + h),
                ""},
               {"flange-tool0", "fixed", "flange", "tool0", Rpy("0 0 0", h + " 0 " + h), ""}},
              "tool0");
}

UrdfRobot Kr15Urdf() {
  return Made("kr15",
              {{"A1", "revolute", "base_link", "link_1", Rpy("0 0 0.675", "0 0 0"), "0 0 -1"},
               {"A2", "revolute", "link_1", "link_2", "xyz=\"0.3 0 0\"", "0 1 0"},
               {"A3", "revolute", "link_2", "link_3", "xyz=\"0.65 0 0\"", "0 2 0"},
               {"A4", "revolute", "link_3", "link_4", "xyz=\"0.1 0 0.155\"", "-1 0 0"},
               {"A5", "revolute", "link_4", "link_5", "xyz=\"0.5 0 0\"", "0 1 0"},
               // Neither <origin> nor <axis>: at the parent's frame, about x.
               {"A6", "continuous", "link_5", "link_6", "", ""},
               {"flange",
                "fixed",
                "link_6",
                "tool0",
                Rpy("0.14 0 0", std::string("0 ") + kHalfPi + " 0"),
                ""}},
              "tool0");
}

UrdfRobot PandaUrdf() {
  const std::string up = std::string(kHalfPi) + " 0 0", down = std::string("-") + kHalfPi + " 0 0";
  return Made(
      "panda",
      {{"panda_joint1",
        "revolute",
        "panda_link0",
        "panda_link1",
        Rpy("0 0 0.333", "0 0 0"),
        "0 0 1"},
       {"panda_joint2", "revolute", "panda_link1", "panda_link2", Rpy("0 0 0", down), "0 0 1"},
       {"panda_joint3", "revolute", "panda_link2", "panda_link3", Rpy("0 -0.316 0", up), "0 0 1"},
       {"panda_joint4", "revolute", "panda_link3", "panda_link4", Rpy("0.0825 0 0", up), "0 0 1"},
       {"panda_joint5",
        "revolute",
        "panda_link4",
        "panda_link5",
        Rpy("-0.0825 0.384 0", down),
        "0 0 1"},
       {"panda_joint6", "revolute", "panda_link5", "panda_link6", Rpy("0 0 0", up), "0 0 1"},
       {"panda_joint7", "revolute", "panda_link6", "panda_link7", Rpy("0.088 0 0", up), "0 0 1"},
       {"panda_joint8", "fixed", "panda_link7", "panda_link8", Rpy("0 0 0.107", "0 0 0"), ""},
       {"hand_joint",
        "fixed",
        "panda_link8",
        "panda_hand",
        Rpy("0 0 0", "0 0 -0.7853981633974483"),
        ""},
       {"finger_joint1",
        "prismatic",
        "panda_hand",
        "panda_leftfinger",
        Rpy("0 0 0.0584", "0 0 0"),
        "0 1 0"}},
      "panda_link8");
}

UrdfRobot ScaraUrdf() {
  return Made(
      "scara",
      {{"J1", "revolute", "base", "arm1", Rpy("0 0 0.22", "0 0 0.1"), "0 0 1"},
       {"J2", "revolute", "arm1", "arm2", Rpy("0.325 0 0.05", "0 0 0"), "0 0 1"},
       {"J3", "prismatic", "arm2", "quill", Rpy("0.275 0 0", "0 0 0"), "0 0 -1"},
       {"J4", "continuous", "quill", "hand", Rpy("0 0 -0.02", "3.141592653589793 0 0"), "0 0 1"},
       {"tool", "fixed", "hand", "tcp", Rpy("0.01 0.02 0.1", "0 0.2 0"), ""}},
      "tcp");
}

UrdfRobot IiwaUrdf() {
  const std::string h = kHalfPi, pi = "3.141592653589793";
  return Made(
      "iiwa",
      {{"joint_1", "revolute", "base", "link_1", Rpy("0 0 0.1575", "0 0 0"), "0 0 1"},
       {"joint_2", "revolute", "link_1", "link_2", Rpy("0 0 0.2025", h + " 0 " + pi), "0 0 1"},
       {"joint_3", "revolute", "link_2", "link_3", Rpy("0 0.2045 0", h + " 0 " + pi), "0 0 1"},
       {"joint_4", "revolute", "link_3", "link_4", Rpy("0 0 0.2155", h + " 0 0"), "0 0 1"},
       {"joint_5",
        "revolute",
        "link_4",
        "link_5",
        Rpy("0 0.1845 0", "-" + h + " " + pi + " 0"),
        "0 0 1"},
       {"joint_6", "revolute", "link_5", "link_6", Rpy("0 0 0.2155", h + " 0 0"), "0 0 1"},
       {"joint_7",
        "revolute",
        "link_6",
        "link_7",
        Rpy("0 0.081 0", "-" + h + " " + pi + " 0"),
        "0 0 1"},
       {"joint_ee", "fixed", "link_7", "link_ee", Rpy("0 0 0.045", "0 0 0"), ""}},
      "link_ee");
}

Eigen::Vector3d AnyVector(double size, Rng* rng) {
  Eigen::Vector3d v;
  for (double& number : v) number = rng->Uniform(-size, size);
  return v;
}

std::string Numbers(const Eigen::Vector3d& v) {
  return fmt::format("{} {} {}", v.x(), v.y(), v.z());
}

Eigen::Matrix3d Turned(const Eigen::Vector3d& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

std::vector<UrdfRobot> PublishedUrdfs() {
  return {Ur10Urdf(), Kr15Urdf(), PandaUrdf(), ScaraUrdf(), IiwaUrdf()};
}

UrdfRobot RandomUrdf(int num_joints, Rng* rng) {
  std::vector<JointText> joints;
  Eigen::Vector3d axis = AnyVector(1, rng);  // of the joint before, in its child's frame
  for (int j = 0; j < num_joints; ++j) {
    const Eigen::Vector3d rpy = AnyVector(3, rng);
    Eigen::Vector3d xyz = AnyVector(0.6, rng);
    const Eigen::Vector3d before = Turned(rpy).transpose() * axis;
    switch (j % 5) {
      case 0:  // skew
        axis = AnyVector(1, rng);
        break;
      case 1:
        axis = before;
        break;
      case 2:
        axis = -before;
        break;
      case 3:
        axis = before + AnyVector(1e-6, rng);
        break;
      default:  // through a point of the axis before
        xyz = axis.normalized() * 0.3;
        axis = AnyVector(1, rng);
    }
    joints.push_back({fmt::format("j{}", j + 1),
                      j % 3 == 2 ? "prismatic" : "revolute",
                      fmt::format("l{}", j),
                      fmt::format("l{}", j + 1),
                      Rpy(Numbers(xyz), Numbers(rpy)),
                      Numbers(axis)});
    axis.normalize();
  }
  joints.push_back({"tip",
                    "fixed",
                    joints.back().child,
                    "tip_link",
                    Rpy(Numbers(AnyVector(0.3, rng)), Numbers(AnyVector(3, rng))),
                    ""});
  return Made("random", joints, "tip_link");
}

std::vector<UrdfRobot> AllUrdfs() {
  std::vector<UrdfRobot> robots = PublishedUrdfs();
  for (int k = 0; k < 8; ++k) {
    Rng rng(100 + static_cast<std::uint64_t>(k));
    robots.push_back(RandomUrdf(3 + k, &rng));
    robots.back().name += std::to_string(k + 1);
  }
  return robots;
}

std::ostream& operator<<(std::ostream& os, const UrdfRobot& robot) { return os << robot.name; }

}  // namespace dhcal
