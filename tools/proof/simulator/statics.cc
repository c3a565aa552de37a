#include "tools/proof/simulator/statics.h"

#include <algorithm>
#include <cmath>

namespace dhcal::concealed {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kGravity = 9.80665;  // [m/s^2]
constexpr int kMostIterations = 60;
constexpr double kAtRest = 1e-14;  // [m], [1] largest change of the last link's motion

struct Load {
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
};

Vector3d Weight(double mass) { return {0, 0, -kGravity * mass}; }

/// An arm as it stands, with what it carries. Refers to its parts.
struct LoadedArm {
  const Arm& arm;
  const ScrewArm& screws;
  const std::vector<Isometry3d>& motions;
  double payload;
};

/// What the bodies beyond link `first` (from 1) put on `point`.
Load LoadBeyond(const LoadedArm& loaded, int first, const Vector3d& point) {
  const auto& [arm, screws, motions, payload] = loaded;
  Load load;
  const auto add = [&](double mass, const Vector3d& where) {
    load.force += Weight(mass);
    load.moment += (where - point).cross(Weight(mass));
  };
  for (int link = first; link <= arm.num_joints(); ++link) {
    const auto i = static_cast<std::size_t>(link);
    add(arm.links[i - 1].mass, motions[i] * (screws.home(link) * arm.links[i - 1].com));
  }
  add(payload, motions.back() * (screws.home(arm.num_joints()) * arm.payload_com));
  return load;
}

/// Two of a gear's stiffness regions: soft around zero torque, stiff beyond.
double TwistOf(const Drive& drive, double torque) {
  const double size = std::abs(torque);
  const double soft = std::min(size, drive.soft_torque);
  const double twist = drive.compliance * (drive.soft_ratio * soft + (size - soft));
  return torque < 0 ? -twist : twist;
}

/// Torque of the spring on joint 2.
double SpringTorque(const Balancer& b, double q2) {
  if (b.stiffness == 0) return 0;
  const double angle = q2 + b.phase;
  const double length =
      std::sqrt(b.column * b.column + b.link * b.link - 2 * b.column * b.link * std::cos(angle));
  return -b.stiffness * (length - b.rest) * b.column * b.link * std::sin(angle) / length;
}

/// A link as a clamped beam from its near to its far joint, loaded at the far end.
Isometry3d Bend(const Vector3d& beam, const Load& load, double flexibility) {
  const double L = beam.norm();
  if (L < 1e-9 || flexibility == 0) return Isometry3d::Identity();
  const Vector3d e = beam / L;
  const Vector3d across_force = load.force - e * e.dot(load.force);
  const Vector3d across_moment = load.moment - e * e.dot(load.moment);
  const Vector3d rotation = flexibility * (L * L / 2 * e.cross(load.force) + L * across_moment);
  const Vector3d shift =
      flexibility * (L * L * L / 3 * across_force + L * L / 2 * load.moment.cross(e));
  return Displacement(rotation, shift);
}

Isometry3d Growth(const Vector3d& beam, double strain) {
  return Displacement(Vector3d::Zero(), strain * beam);
}

/// What a link and the shape of a modified row before its joint add as they grow.
void Grow(const ScrewArm& screws,
          const std::vector<double>& growth,
          std::vector<Isometry3d>* bends) {
  for (std::size_t i = 0; i < growth.size(); ++i) {
    if (growth[i] == 0) continue;
    const auto j = static_cast<int>(i);
    // From the frame of the row before to the joint's axis lies the body before; along the axis and
    // beyond lies the link. (The first row's shape is the base's: drawn without length.)
    const Vector3d before = screws.start(j).translation() - screws.home(j).translation();
    const Vector3d own = screws.home(j + 1).translation() - screws.start(j).translation();
    const auto add = [&](std::size_t link, const Vector3d& length) {
      const Eigen::Matrix3d to_end = screws.end(static_cast<int>(link)).linear().transpose();
      (*bends)[link] = Growth(to_end * length, growth[i]) * (*bends)[link];
    };
    if (i > 0 && before.norm() > 0) add(i - 1, before);
    add(i, own);
  }
}

/// How every link's far end is displaced, in the frame there.
std::vector<Isometry3d> Bends(const Arm& arm,
                              const ScrewArm& screws,
                              const Physics& physics,
                              const std::vector<Isometry3d>& motions,
                              const Circumstances& at) {
  std::vector<Isometry3d> bends;
  for (int joint = 0; joint < arm.num_joints(); ++joint) {
    const auto i = static_cast<std::size_t>(joint);
    const Isometry3d end = motions[i + 1] * screws.end(joint);
    const Vector3d near = motions[i] * screws.start(joint).translation();
    const Eigen::Matrix3d to_end = end.linear().transpose();
    const Vector3d beam = to_end * (end.translation() - near);
    Load load = LoadBeyond({arm, screws, motions, at.payload}, joint + 2, end.translation());
    load.force = to_end * load.force;
    load.moment = to_end * load.moment;
    bends.emplace_back(Bend(beam, load, physics.link_flexibility[i]));
  }
  Grow(screws, at.growth, &bends);
  return bends;
}

}  // namespace

VectorXd GravityTorques(const Arm& arm,
                        const ScrewArm& screws,
                        const std::vector<Isometry3d>& motions,
                        double payload) {
  VectorXd torques(arm.num_joints());
  for (int j = 0; j < arm.num_joints(); ++j) {
    const Isometry3d& before = motions[static_cast<std::size_t>(j)];
    const Vector3d point = before * screws.start(j).translation();
    const Vector3d axis = before.linear() * screws.start(j).linear().col(2);
    const Load load = LoadBeyond({arm, screws, motions, payload}, j + 1, point);
    torques[j] = axis.dot(arm.links[static_cast<std::size_t>(j)].slides ? load.force : load.moment);
  }
  return torques;
}

VectorXd RigidTorques(const Arm& arm, const ScrewArm& screws, const VectorXd& q, double payload) {
  const std::vector<Isometry3d> straight(static_cast<std::size_t>(arm.num_joints()),
                                         Isometry3d::Identity());
  return GravityTorques(arm, screws, screws.Motions(q, straight), payload);
}

Isometry3d Equilibrium(const Arm& arm,
                       const ScrewArm& screws,
                       const Physics& physics,
                       const VectorXd& q,
                       const Circumstances& at) {
  std::vector<Isometry3d> bends(static_cast<std::size_t>(arm.num_joints()), Isometry3d::Identity());
  VectorXd twist = VectorXd::Zero(arm.num_joints());
  std::vector<Isometry3d> motions = screws.Motions(q + at.held, bends, at.tilts);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    VectorXd torque = GravityTorques(arm, screws, motions, at.payload);
    if (arm.num_joints() > 1) torque[1] += SpringTorque(physics.balancer, q[1]);
    for (int j = 0; j < arm.num_joints(); ++j) {
      twist[j] = TwistOf(physics.drives[static_cast<std::size_t>(j)], torque[j]);
    }
    bends = Bends(arm, screws, physics, motions, at);
    const Isometry3d before = motions.back();
    motions = screws.Motions(q + at.held + twist, bends, at.tilts);
    if ((motions.back().matrix() - before.matrix()).cwiseAbs().maxCoeff() < kAtRest) break;
  }
  const Vector3d overturning =
      LoadBeyond({arm, screws, motions, at.payload}, 1, Vector3d::Zero()).moment;
  const Vector3d tilt(physics.base_compliance.x() * overturning.x(),
                      physics.base_compliance.y() * overturning.y(),
                      0);
  return Displacement(tilt, Vector3d::Zero()) * motions.back() * screws.home(arm.num_joints());
}

}  // namespace dhcal::concealed
