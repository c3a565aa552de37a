#include "tools/proof/simulator/random/random_trial.h"

#include <algorithm>
#include <cmath>

#include "tools/proof/simulator/random/draw.h"
#include "tools/proof/simulator/random/draw_causes.h"
#include "tools/proof/simulator/random/oracle.h"
#include "tools/proof/simulator/random/poses.h"
#include "tools/proof/simulator/random/recorded_columns.h"
#include "tools/proof/simulator/screw.h"

namespace dhcal::concealed {
namespace {

using Eigen::Vector3d;

/// Files hold base, tool or tilts fixed that are off in some recordings.
void ForgetGeometry(RandomTrial* trial, Rng* rng) {
  if (trial->settings.complete || !Chance(0.3, rng)) return;
  Arm* built = &trial->built;
  const int which = DrawInt(3, rng);
  if (which == 0) {
    built->base = built->base * Displacement(1e-3 * DrawDirection(rng), 3e-3 * DrawDirection(rng));
    trial->geometry = {"base_frame"};
  } else if (which == 1) {
    built->tool = built->tool * Eigen::Translation3d(3e-3 * DrawDirection(rng));
    for (Eigen::Isometry3d& target : built->targets) {
      target = target * Eigen::Translation3d(3e-3 * DrawDirection(rng));
    }
    trial->geometry = {"tool_offset"};
  } else {
    for (int joint = 0, row = 0; joint < built->num_joints(); ++joint) {
      if (!DrawnParallel(trial->drawing, joint, &row)) continue;
      built->links[static_cast<std::size_t>(row)].beta = 1e-3 * rng->Normal();
      trial->geometry = {"axis_tilt"};
    }
  }
}

void MisstateMasses(const Settings& settings, Arm* arm, Rng* rng) {
  if (settings.masses != Said::kWrong) return;
  for (DrawnLink& link : arm->links) {
    link.mass *= std::max(0.3, 1 + 0.2 * rng->Normal());
    link.com += 0.025 * Vector3d(rng->Normal(), rng->Normal(), rng->Normal());
  }
}

/// Air and floors move where nothing else is wrong. (Beside a cause the oracle would have to know
/// which of them it hides.) A stream of its own: trials were drawn before this was.
void LetNoiseWander(RandomTrial* trial) {
  constexpr std::uint64_t kStream = 104651;
  Rng rng(trial->seed * 1000003 + kStream);
  Settings* s = &trial->settings;
  const bool independent = s->kind == Kind::kAdjacent && !s->shared_pose;
  if (!trial->causes.empty() || s->repeats > 1 || independent || !Chance(0.3, &rng)) return;
  s->wandering = rng.Uniform(0.05, 0.6);
  s->wandering_on = rng.Uniform(0.6, 0.98);
}

void PlaceAnchors(RandomTrial* trial, Rng* rng) {
  const Eigen::Isometry3d& base = trial->drawing.base;
  for (const Vector3d& place :
       {Vector3d(2.5, 0, 0.2), Vector3d(0, 2.8, 1.5), Vector3d(-2, -2, 2.2)}) {
    trial->anchors.emplace_back(base * place);
  }
  for (int row = 0; row < trial->motion.num_poses(); ++row) {
    trial->anchor.push_back(DrawInt(static_cast<int>(trial->anchors.size()), rng));
  }
}

void SetUpAnew(RandomTrial* trial, Rng* rng) {
  if (trial->settings.setups != Setups::kStated) return;
  for (int run = 0; run < trial->settings.runs; ++run) {
    trial->setups.push_back({3e-3 * DrawDirection(rng), 2e-3 * DrawDirection(rng)});
  }
}

}  // namespace

Physics StatedPhysics(const RandomTrial& trial) {
  Physics physics(trial.built.num_joints());
  physics.base_of_run = trial.setups;
  return physics;
}

Physics AllPhysics(const RandomTrial& trial) { return PhysicsWithout(trial, trial.causes.size()); }

Physics PhysicsWithout(const RandomTrial& trial, std::size_t cause) {
  Physics physics = StatedPhysics(trial);
  for (std::size_t k = 0; k < trial.causes.size(); ++k) {
    if (k != cause) trial.causes[k].apply(&physics, 1);
  }
  return physics;
}

RandomTrial MakeRandomTrial(int seed) {
  constexpr std::uint64_t kStream = 7919;  // apart from those of the scenarios
  Rng rng(static_cast<std::uint64_t>(seed) * 1000003 + kStream);
  RandomTrial trial;
  trial.seed = static_cast<std::uint64_t>(seed);
  trial.settings = DrawSettings(&rng);
  trial.drawing = DrawArm(trial.settings, &rng);
  trial.built = trial.settings.complete ? AsBuilt(trial.drawing, &rng)
                                        : AsBuiltInRowsOnly(trial.drawing, &rng);
  ForgetGeometry(&trial, &rng);
  trial.stated = trial.drawing;
  MisstateMasses(trial.settings, &trial.stated, &rng);
  trial.motion = DrawMotion(trial.settings, trial.drawing, &rng);
  PlaceAnchors(&trial, &rng);
  SetUpAnew(&trial, &rng);
  trial.columns = DrawColumns(trial, &rng);
  DrawCauses(&trial, &rng);
  WeighCauses(&trial);
  LetNoiseWander(&trial);
  return trial;
}

}  // namespace dhcal::concealed
