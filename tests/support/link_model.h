// A robot as its maker's description has it (URDF): a fixed shift and turn to each joint and the
// axis about which it turns or along which it slides. Judges DH rows by numbers and by a product
// that know nothing of them.
#ifndef DHCAL_TESTS_SUPPORT_LINK_MODEL_H_
#define DHCAL_TESTS_SUPPORT_LINK_MODEL_H_

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace dhcal {

struct LinkModelJoint {
  Eigen::Vector3d shift;                          // [m] from the joint before
  Eigen::Vector3d axis;                           // unit vector, in the axes behind the turn
  Eigen::Vector3d rpy = Eigen::Vector3d::Zero();  // [rad] about the fixed x, y, z in this order
  bool slides = false;
};

struct LinkModel {
  std::vector<LinkModelJoint> joints;
  Eigen::Vector3d flange = Eigen::Vector3d::Zero();  // [m] from the last joint, in its axes
};

/// Pose of the last link's axes at the flange, for joint coordinates [rad or m].
inline Eigen::Isometry3d FlangeOf(const LinkModel& model, const Eigen::VectorXd& q) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const LinkModelJoint& joint = model.joints[i];
    const double value = q[static_cast<Eigen::Index>(i)];
    X.translate(joint.shift);
    X.rotate(Eigen::AngleAxisd(joint.rpy.z(), Eigen::Vector3d::UnitZ()) *
             Eigen::AngleAxisd(joint.rpy.y(), Eigen::Vector3d::UnitY()) *
             Eigen::AngleAxisd(joint.rpy.x(), Eigen::Vector3d::UnitX()));
    if (joint.slides) {
      X.translate(value * joint.axis);
    } else {
      X.rotate(Eigen::AngleAxisd(value, joint.axis));
    }
  }
  X.translate(model.flange);
  return X;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_LINK_MODEL_H_
