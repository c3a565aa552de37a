#include "tools/proof/simulator/arm.h"

#include <cmath>

#include "core/base/units.h"

namespace dhcal::concealed {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

VectorXd Degrees(const std::vector<double>& values) {
  VectorXd radians(static_cast<Eigen::Index>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k) {
    radians[static_cast<Eigen::Index>(k)] = values[k] * kDegree;
  }
  return radians;
}

DrawnLink Link(
    double theta_deg, double d, double a, double alpha_deg, double mass, const Vector3d& com) {
  DrawnLink link;
  link.theta = theta_deg * kDegree;
  link.d = d;
  link.a = a;
  link.alpha = alpha_deg * kDegree;
  link.mass = mass;
  link.com = com;
  return link;
}

Vector3d NormalVector(Rng* rng) {
  const double x = rng->Normal(), y = rng->Normal(), z = rng->Normal();
  return {x, y, z};
}

Isometry3d Shifted(const Isometry3d& X, double angle, double length, Rng* rng) {
  const Vector3d rotation = angle * NormalVector(rng);
  return X * Displacement(rotation, length * NormalVector(rng));
}

}  // namespace

Arm KukaKr15() {
  Arm arm;
  arm.name = "kr15";
  arm.title = "KUKA KR 15/2";
  arm.links = {Link(0, 0.675, 0.3, 90, 60, {-0.2, 0.1, 0}),
               Link(0, 0, 0.65, 0, 40, {-0.35, 0, 0.05}),
               Link(0, 0, 0.155, 90, 35, {-0.02, 0, 0.1}),
               Link(0, 0.6, 0, -90, 15, {0, 0.15, 0}),
               Link(0, 0, 0, 90, 8, {0, 0, 0.03}),
               Link(0, 0.14, 0, 0, 3, {0, 0, -0.03})};
  arm.tool.translation() = Vector3d(0.06, 0.02, 0.2);
  arm.payload = 10;
  arm.payload_com = Vector3d(0.05, 0, 0.12);
  arm.middle = Degrees({0, 60, 10, 0, 40, 0});
  arm.wide = Degrees({170, 60, 80, 170, 100, 170});
  arm.narrow = Degrees({35, 20, 20, 60, 30, 90});
  return arm;
}

Arm UniversalUr10() {
  Arm arm;
  arm.name = "ur10";
  arm.title = "Universal Robots UR10";
  arm.links = {Link(0, 0.1273, 0, 90, 7.778, {0, -0.04, 0}),
               Link(0, 0, -0.612, 0, 12.93, {0.3, 0, 0.15}),
               Link(0, 0, -0.5723, 0, 3.87, {0.27, 0, 0.06}),
               Link(0, 0.163941, 0, 90, 1.96, {0, -0.02, 0.01}),
               Link(0, 0.1157, 0, -90, 1.96, {0, 0.02, 0.01}),
               Link(0, 0.0922, 0, 0, 0.202, {0, 0, -0.03})};
  arm.tool.translation() = Vector3d(0.03, 0.06, 0.11);
  arm.payload = 5;
  arm.payload_com = Vector3d(0.03, 0, 0.1);
  arm.main_compliance = 15e-6;
  arm.wrist_compliance = 60e-6;
  arm.base_compliance = 1e-6;
  arm.middle = Degrees({0, -70, 80, -90, -80, 0});
  arm.wide = Degrees({170, 70, 90, 150, 100, 170});
  arm.narrow = Degrees({35, 20, 20, 60, 30, 90});
  return arm;
}

Arm SmallArm() {
  Arm arm;
  arm.name = "small";
  arm.title = "Small arm of 0.6 m reach";
  arm.links = {Link(0, 0.29, 0, -90, 3.07, {0, 0.04, 0}),
               Link(-90, 0, 0.27, 0, 3.91, {-0.17, 0, 0}),
               Link(0, 0, 0.07, -90, 2.94, {-0.01, 0, 0.05}),
               Link(0, 0.302, 0, 90, 1.33, {0, -0.08, 0}),
               Link(0, 0, 0, -90, 0.55, {0, 0, 0.01}),
               Link(0, 0.072, 0, 0, 0.14, {0, 0, -0.01})};
  arm.tool.translation() = Vector3d(0.04, 0.01, 0.1);
  arm.payload = 2;
  arm.payload_com = Vector3d(0.02, 0, 0.06);
  arm.noise = 0.015e-3;
  arm.main_compliance = 20e-6;
  arm.wrist_compliance = 150e-6;
  arm.base_compliance = 2e-6;
  arm.middle = Degrees({0, 20, 10, 0, 40, 0});
  arm.wide = Degrees({160, 70, 60, 155, 100, 170});
  arm.narrow = Degrees({35, 20, 20, 60, 30, 90});
  return arm;
}

Arm AsBuilt(const Arm& drawing, Rng* rng) {
  Arm arm = drawing;
  for (DrawnLink& link : arm.links) {
    const bool parallel = std::abs(std::sin(link.alpha)) < 1e-6;
    link.theta += 3e-3 * rng->Normal();
    link.alpha += 1e-3 * rng->Normal();
    link.d += 0.3e-3 * rng->Normal();
    link.a += 0.3e-3 * rng->Normal();
    if (parallel) link.beta += 0.4e-3 * rng->Normal();
  }
  arm.base = Shifted(arm.base, 3e-3, 2e-3, rng);
  arm.tool = Shifted(arm.tool, 3e-3, 1e-3, rng);
  return arm;
}

ScrewArm::ScrewArm(const Arm& arm) : homes_{Isometry3d::Identity()} {
  for (const DrawnLink& link : arm.links) {
    const Isometry3d& near = homes_.back();
    axes_.push_back(AxisThrough(near.translation(), near.linear().col(2)));
    homes_.emplace_back(
        near * AngleAxisd(link.theta, Vector3d::UnitZ()) * Translation3d(link.a, 0, link.d) *
        AngleAxisd(link.alpha, Vector3d::UnitX()) * AngleAxisd(link.beta, Vector3d::UnitY()));
  }
}

std::vector<Isometry3d> ScrewArm::Motions(const VectorXd& q,
                                          const std::vector<Isometry3d>& bends) const {
  std::vector<Isometry3d> motions = {Isometry3d::Identity()};
  for (int j = 0; j < num_joints(); ++j) {
    const Isometry3d& end = home(j + 1);
    const Isometry3d bend = end * bends[static_cast<std::size_t>(j)] * end.inverse();
    motions.emplace_back(motions.back() * Exp(axis(j), q[j]) * bend);
  }
  return motions;
}

}  // namespace dhcal::concealed
