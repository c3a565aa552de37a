#include "problems/formats/urdf/urdf_tree.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <urdf_parser/urdf_parser.h>

#include "core/io/text_file.h"
#include "problems/formats/urdf/urdf_places.h"

namespace dhcal {
namespace {

/// What urdfdom says instead of printing it, while this lives.
class UrdfdomMessages : public console_bridge::OutputHandler {
 public:
  UrdfdomMessages() { console_bridge::useOutputHandler(this); }
  ~UrdfdomMessages() override { console_bridge::restorePreviousOutputHandler(); }
  UrdfdomMessages(const UrdfdomMessages&) = delete;
  UrdfdomMessages& operator=(const UrdfdomMessages&) = delete;

  void log(const std::string& text,
           console_bridge::LogLevel level,
           const char* /*file*/,
           int /*line*/) override {
    if (level == console_bridge::CONSOLE_BRIDGE_LOG_ERROR) errors_.push_back(text);
  }
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  std::vector<std::string> errors_;
};

/// The joint or link that one of the messages names, [so] or 'so'; else the start of the file.
std::size_t PlaceOfMessages(const std::vector<std::string>& messages, const UrdfPlaces& places) {
  const auto named = [&messages](const std::string& name) {
    return std::any_of(messages.begin(), messages.end(), [&name](const std::string& message) {
      return message.find("[" + name + "]") != std::string::npos ||
             message.find("'" + name + "'") != std::string::npos;
    });
  };
  for (const auto& [name, place] : places.joints) {
    if (named(name)) return place.joint.begin;
  }
  for (const auto& [name, byte] : places.links) {
    if (named(name)) return byte;
  }
  return 0;
}

Eigen::Isometry3d PoseOf(const urdf::Pose& pose) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const urdf::Rotation& q = pose.rotation;
  X.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  X.translation() << pose.position.x, pose.position.y, pose.position.z;
  return X;
}

UrdfJointType TypeOf(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return UrdfJointType::kRevolute;
    case urdf::Joint::CONTINUOUS:
      return UrdfJointType::kContinuous;
    case urdf::Joint::PRISMATIC:
      return UrdfJointType::kPrismatic;
    case urdf::Joint::FLOATING:
      return UrdfJointType::kFloating;
    case urdf::Joint::PLANAR:
      return UrdfJointType::kPlanar;
    default:
      return UrdfJointType::kFixed;
  }
}

UrdfJoint JointOf(const urdf::Joint& joint) {
  UrdfJoint result;
  result.name = joint.name;
  result.type = TypeOf(joint);
  result.parent = joint.parent_link_name;
  result.child = joint.child_link_name;
  result.X_PC = PoseOf(joint.parent_to_joint_origin_transform);
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  // Zero is told where the axis matters.
  result.axis_C = axis.norm() > 0 ? axis.normalized() : Eigen::Vector3d::Zero();
  const bool bounded =
      result.type == UrdfJointType::kRevolute || result.type == UrdfJointType::kPrismatic;
  // Limits that are left out are zero in urdfdom.
  if (bounded && joint.limits && joint.limits->lower < joint.limits->upper) {
    result.lower = joint.limits->lower;
    result.upper = joint.limits->upper;
  }
  if (joint.mimic) result.mimics = joint.mimic->joint_name;
  return result;
}

UrdfLink LinkOf(const urdf::Link& link) {
  UrdfLink result;
  if (link.parent_joint) result.parent_joint = link.parent_joint->name;
  for (const auto& joint : link.child_joints) result.child_joints.push_back(joint->name);
  if (link.inertial) {
    const urdf::Vector3& p = link.inertial->origin.position;
    result.inertial = {link.inertial->mass, Eigen::Vector3d(p.x, p.y, p.z)};
  }
  return result;
}

/// urdfdom keeps one of the joints that lead to a link; there must not be a second.
bool EachLinkHasOneParent(const UrdfTree& tree, Diagnostics* diagnostics) {
  std::map<std::string, std::string> parent_of;
  bool ok = true;
  for (const auto& [name, joint] : tree.joints) {
    const auto [other, is_new] = parent_of.emplace(joint.child, name);
    if (is_new) continue;
    diagnostics->Error(joint.where,
                       fmt::format("link '{}' is the child of joint '{}' and of joint '{}'; a URDF "
                                   "is a tree, and each link has one parent",
                                   joint.child,
                                   other->second,
                                   name));
    ok = false;
  }
  return ok;
}

}  // namespace

std::optional<UrdfTree> ParseUrdf(const std::string& file,
                                  const std::string& text,
                                  Diagnostics* diagnostics) {
  const std::optional<UrdfPlaces> places = FindUrdfPlaces(file, text, diagnostics);
  if (!places) return std::nullopt;
  const UrdfdomMessages messages;
  urdf::ModelInterfaceSharedPtr model;
  std::string thrown;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    thrown = error.what();
  }
  if (!model || !model->getRoot()) {
    std::vector<std::string> why = messages.errors();
    if (!thrown.empty()) why.push_back(thrown);
    diagnostics->Error(
        PlaceInText(file, text, PlaceOfMessages(why, *places)),
        fmt::format("ROS cannot read this URDF either; its parser says: {}", fmt::join(why, "; ")));
    return std::nullopt;
  }
  UrdfTree tree;
  tree.file = file;
  tree.text = text;
  tree.name = model->getName();
  tree.root = model->getRoot()->name;
  for (const auto& [name, joint] : model->joints_) {
    tree.joints[name] = JointOf(*joint);
    tree.joints[name].where = PlaceInText(file, text, places->joints.at(name).joint.begin);
  }
  for (const auto& [name, link] : model->links_) tree.links[name] = LinkOf(*link);
  if (!EachLinkHasOneParent(tree, diagnostics)) return std::nullopt;
  return tree;
}

std::optional<UrdfTree> ReadUrdf(const std::string& file, Diagnostics* diagnostics) {
  const std::optional<std::string> text = ReadTextFile(file, diagnostics);
  return text ? ParseUrdf(file, *text, diagnostics) : std::nullopt;
}

}  // namespace dhcal
