#include "tools/proof/simulator/arm.h"

#include <cmath>

namespace dhcal::concealed {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kParallel = 1e-6;  // sine of the angle between axes that are drawn parallel

Vector3d NormalVector(Rng* rng) {
  const double x = rng->Normal(), y = rng->Normal(), z = rng->Normal();
  return {x, y, z};
}

Isometry3d Shifted(const Isometry3d& X, double angle, double length, Rng* rng) {
  const Vector3d rotation = angle * NormalVector(rng);
  return X * Displacement(rotation, length * NormalVector(rng));
}

}  // namespace

bool DrawnParallel(const Arm& drawing, int joint, int* row) {
  if (joint < 0 || joint + 1 >= drawing.num_joints()) return false;
  *row = drawing.convention == Convention::kStandard ? joint : joint + 1;
  const DrawnLink& between = drawing.links[static_cast<std::size_t>(*row)];
  return std::abs(std::sin(between.alpha)) < kParallel;
}

Arm AsBuilt(const Arm& drawing, Rng* rng) {
  Arm arm = drawing;
  for (DrawnLink& link : arm.links) {
    const bool parallel = std::abs(std::sin(link.alpha)) < kParallel;
    link.theta += 3e-3 * rng->Normal();
    link.alpha += 1e-3 * rng->Normal();
    link.d += 0.3e-3 * rng->Normal();
    link.a += 0.3e-3 * rng->Normal();
    if (parallel) link.beta += 0.4e-3 * rng->Normal();
  }
  arm.base = Shifted(arm.base, 3e-3, 2e-3, rng);
  arm.tool = Shifted(arm.tool, 3e-3, 1e-3, rng);
  for (Isometry3d& target : arm.targets) target = Shifted(target, 3e-3, 1e-3, rng);
  return arm;
}

Arm AsBuiltInRowsOnly(const Arm& drawing, Rng* rng) {
  Arm arm = AsBuilt(drawing, rng);
  for (std::size_t i = 0; i < arm.links.size(); ++i) arm.links[i].beta = drawing.links[i].beta;
  arm.base = drawing.base;
  arm.tool = drawing.tool;
  arm.targets = drawing.targets;
  return arm;
}

ScrewArm::ScrewArm(const Arm& arm) : homes_{Isometry3d::Identity()} {
  const auto turn = [](double angle, const Vector3d& axis) { return AngleAxisd(angle, axis); };
  for (const DrawnLink& link : arm.links) {
    const Isometry3d joint_motion =
        turn(link.theta, Vector3d::UnitZ()) * Isometry3d(Translation3d(0, 0, link.d));
    const Isometry3d shape = Translation3d(link.a, 0, 0) *
                             Isometry3d(turn(link.alpha, Vector3d::UnitX())) *
                             turn(link.beta, Vector3d::UnitY());
    const bool standard = arm.convention == Convention::kStandard;
    const Isometry3d start = standard ? homes_.back() : homes_.back() * shape;
    starts_.push_back(start);
    axes_.push_back(link.slides ? SlideAlong(start.linear().col(2))
                                : AxisThrough(start.translation(), start.linear().col(2)));
    homes_.emplace_back(standard ? start * joint_motion * shape : start * joint_motion);
  }
  for (std::size_t i = 0; i < arm.links.size(); ++i) {
    const bool inner = arm.convention == Convention::kModified && i + 1 < arm.links.size();
    ends_.push_back(inner ? starts_[i + 1] : homes_[i + 1]);
  }
}

std::vector<Isometry3d> ScrewArm::Motions(const VectorXd& q,
                                          const std::vector<Isometry3d>& bends,
                                          const std::vector<Eigen::Vector2d>& tilts) const {
  std::vector<Isometry3d> motions = {Isometry3d::Identity()};
  for (int j = 0; j < num_joints(); ++j) {
    const auto i = static_cast<std::size_t>(j);
    Isometry3d motion = motions.back();
    if (!tilts.empty()) {
      const Vector3d tilt(tilts[i].x(), tilts[i].y(), 0);
      motion = motion * start(j) * Displacement(tilt, Vector3d::Zero()) * start(j).inverse();
    }
    const Isometry3d bend = end(j) * bends[i] * end(j).inverse();
    motions.emplace_back(motion * Exp(axis(j), q[j]) * bend);
  }
  return motions;
}

}  // namespace dhcal::concealed
