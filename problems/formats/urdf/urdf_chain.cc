#include "problems/formats/urdf/urdf_chain.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/kinematics/dh_chain.h"
#include "core/kinematics/dh_rows.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;

std::vector<std::string> LinkNames(const UrdfTree& tree) {
  std::vector<std::string> names;
  for (const auto& [name, link] : tree.links) names.push_back(name);
  return names;
}

bool LinkExists(const UrdfTree& tree,
                const std::string& name,
                const SourceLocation& where,
                Diagnostics* diagnostics) {
  if (tree.links.count(name) > 0) return true;
  const std::string nearest = NearestName(name, LinkNames(tree));
  diagnostics->Error(
      where,
      fmt::format("{} has no link '{}'{}",
                  tree.file,
                  Printable(name),
                  nearest.empty() ? "; its links are " + QuotedList(LinkNames(tree), "and")
                                  : "; did you mean '" + nearest + "'?"));
  return false;
}

/// The only link without children, or "" after an error.
std::string OnlyTip(const UrdfTree& tree, const UrdfEnds& ends, Diagnostics* diagnostics) {
  std::vector<std::string> tips;
  for (const auto& [name, link] : tree.links) {
    if (link.child_joints.empty()) tips.push_back(name);
  }
  if (tips.size() == 1) return tips.front();
  diagnostics->Error(ends.tip_where,
                     fmt::format("{} branches: say at which link the chain ends, tip_link: {}",
                                 tree.file,
                                 QuotedList(tips)));
  return "";
}

/// Joints from the base down to the tip; nothing when the tip is not below the base.
std::optional<std::vector<std::string>> JointsBetween(const UrdfTree& tree,
                                                      const std::string& base,
                                                      const std::string& tip) {
  std::vector<std::string> joints;
  for (std::string link = tip; link != base;) {
    const std::string& joint = tree.links.at(link).parent_joint;
    if (joint.empty()) return std::nullopt;
    joints.push_back(joint);
    link = tree.joints.at(joint).parent;
  }
  std::reverse(joints.begin(), joints.end());
  return joints;
}

/// Why a joint that moves cannot be one of a serial robot; empty when it can.
std::string WhyNotSerial(const UrdfJoint& joint) {
  if (joint.type == UrdfJointType::kFloating || joint.type == UrdfJointType::kPlanar) {
    return fmt::format(
        "is {}: it has no one axis. A chain here has revolute, continuous, prismatic "
        "and fixed joints; begin it behind this joint, with base_link: {}",
        joint.type == UrdfJointType::kFloating ? "floating" : "planar",
        joint.child);
  }
  if (!joint.mimics.empty()) {
    return fmt::format(
        "mimics joint '{}': its coordinate is not one of its own, and the rows here have "
        "one for each joint. End the chain before it, with tip_link: {}",
        joint.mimics,
        joint.parent);
  }
  if (joint.axis_C.isZero(0)) return "has an <axis> of length zero; give it a direction";
  return "";
}

/// Adds a link's mass, and those that hang on it, to `sum` (mass, and mass times centre).
class MassSum {
 public:
  MassSum(const UrdfTree& tree, const UrdfChain& chain) : tree_(tree), chain_(chain) {}

  void Add(const std::string& name, const Isometry3d& X_AL) {
    const UrdfLink& link = tree_.links.at(name);
    mass_ += link.inertial.mass;
    moment_ += link.inertial.mass * (X_AL * link.inertial.p_LC);
    for (const std::string& child : link.child_joints) {
      if (std::count(chain_.joints.begin(), chain_.joints.end(), child) > 0) continue;
      const UrdfJoint& joint = tree_.joints.at(child);
      if (joint.moves()) beside_.push_back(child);
      Add(joint.child, X_AL * joint.X_PC);
    }
  }
  double mass() const { return mass_; }
  Eigen::Vector3d p_AC() const { return moment_ / mass_; }
  const std::vector<std::string>& beside() const { return beside_; }

 private:
  const UrdfTree& tree_;
  const UrdfChain& chain_;
  double mass_ = 0;
  Eigen::Vector3d moment_ = Eigen::Vector3d::Zero();
  std::vector<std::string> beside_;  // joints that move, but not in the chain
};

/// Masses in the frames of the rows; none where the file has none.
void AddMasses(const UrdfTree& tree,
               const UrdfChain& chain,
               const std::vector<Isometry3d>& X_AL,
               RobotModel* robot,
               Diagnostics* diagnostics) {
  std::vector<LinkMass> links(chain.joints.size());
  std::vector<std::string> beside;
  bool any = false;
  for (std::size_t j = 0; j < links.size(); ++j) {
    MassSum sum(tree, chain);
    sum.Add(tree.joints.at(chain.joints[j]).child, chain.X_AC[j]);
    beside.insert(beside.end(), sum.beside().begin(), sum.beside().end());
    if (!(sum.mass() > 0)) continue;
    links[j] = {sum.mass(), X_AL[j].inverse() * sum.p_AC()};
    any = true;
  }
  if (!any) return;
  robot->links = links;
  if (beside.empty()) return;
  diagnostics->Note(tree.joints.at(beside.front()).where,
                    fmt::format("{} {} beside the chain: the masses behind count where they are at "
                                "zero",
                                QuotedList(beside, "and"),
                                beside.size() == 1 ? "moves" : "move"));
}

}  // namespace

std::optional<UrdfChain> FindUrdfChain(const UrdfTree& tree,
                                       const UrdfEnds& ends,
                                       Diagnostics* diagnostics) {
  UrdfChain chain;
  chain.base_link = ends.base_link.empty() ? tree.root : ends.base_link;
  chain.tip_link = ends.tip_link.empty() ? OnlyTip(tree, ends, diagnostics) : ends.tip_link;
  if (chain.tip_link.empty() || !LinkExists(tree, chain.base_link, ends.base_where, diagnostics) ||
      !LinkExists(tree, chain.tip_link, ends.tip_where, diagnostics)) {
    return std::nullopt;
  }
  const auto joints = JointsBetween(tree, chain.base_link, chain.tip_link);
  if (!joints) {
    const bool reversed = JointsBetween(tree, chain.tip_link, chain.base_link).has_value();
    diagnostics->Error(ends.tip_where,
                       fmt::format("link '{}' is not below link '{}' in {}{}",
                                   chain.tip_link,
                                   chain.base_link,
                                   tree.file,
                                   reversed ? "; exchange base_link and tip_link" : ""));
    return std::nullopt;
  }
  bool ok = true;
  for (const std::string& name : *joints) {
    const UrdfJoint& joint = tree.joints.at(name);
    chain.X_AE = chain.X_AE * joint.X_PC;
    if (!joint.moves()) continue;
    chain.joints.push_back(name);
    chain.X_AC.push_back(chain.X_AE);
    const std::string why = WhyNotSerial(joint);
    if (why.empty()) continue;
    diagnostics->Error(joint.where, fmt::format("joint '{}' {}", name, why));
    ok = false;
  }
  if (chain.joints.empty()) {
    diagnostics->Error(ends.tip_where,
                       fmt::format("no joint moves between the links '{}' and '{}' of {}",
                                   chain.base_link,
                                   chain.tip_link,
                                   tree.file));
    ok = false;
  }
  return ok ? std::optional(chain) : std::nullopt;
}

RobotModel RobotOfUrdf(const UrdfTree& tree, const UrdfChain& chain, Diagnostics* diagnostics) {
  std::vector<JointAxis> axes;
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    const UrdfJoint& joint = tree.joints.at(chain.joints[j]);
    axes.push_back(
        {joint.type == UrdfJointType::kPrismatic ? JointType::kPrismatic : JointType::kRevolute,
         chain.X_AC[j].translation(),
         chain.X_AC[j].linear() * joint.axis_C});
  }
  const RowsOfAxes rows = StandardRows(axes, chain.X_AE);
  RobotModel robot;
  robot.name = tree.name;
  robot.joints = rows.rows;
  std::vector<Isometry3d> X_AL;
  for (const Isometry3d& X_BL :
       DhChain(robot).LinkFrames(Eigen::VectorXd::Zero(robot.num_joints()))) {
    X_AL.push_back(rows.X_AB * X_BL);
  }
  X_AL.erase(X_AL.begin());  // the base's
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    const UrdfJoint& joint = tree.joints.at(chain.joints[j]);
    robot.joints[j].name = joint.name;
    robot.joints[j].lower = joint.lower;
    robot.joints[j].upper = joint.upper;
    robot.joints[j].where = joint.where;
  }
  AddMasses(tree, chain, X_AL, &robot, diagnostics);
  FoldIntoEnds(rows.X_AB, rows.X_TE, &robot);
  return robot;
}

}  // namespace dhcal
