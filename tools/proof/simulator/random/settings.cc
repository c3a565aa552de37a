#include "tools/proof/simulator/random/settings.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/units.h"
#include "tools/proof/simulator/arms.h"
#include "tools/proof/simulator/random/draw.h"

namespace dhcal::concealed {
namespace {

void DrawReadings(Settings* s, Rng* rng) {
  constexpr double kMicrometre = 1e-6;
  s->kind = static_cast<Kind>(DrawIndex({0.58, 0.18, 0.1, 0.14}, rng));
  s->shared_pose = Chance(0.5, rng);
  s->noise = DrawValue({{10, 1}, {30, 1}, {50, 1}, {100, 1}}, rng) * kMicrometre;
  s->noise_rotation = DrawValue({{20, 1}, {50, 1}, {100, 1}}, rng) * 1e-6;
  s->tail = static_cast<Tail>(DrawIndex({0.7, 0.15, 0.15}, rng));
  s->outliers = DrawValue({{0, 0.6}, {0.01, 0.15}, {0.03, 0.15}, {0.06, 0.07}, {0.1, 0.03}}, rng);
}

void DrawFile(Settings* s, Rng* rng) {
  s->complete = Chance(0.5, rng);
  s->far = Chance(0.5, rng);
  s->sigma = static_cast<Said>(DrawIndex({0.55, 0.15, 0.3}, rng));
  s->sigma_factor = s->sigma == Said::kWrong ? DrawValue({{0.5, 1}, {2, 1}}, rng) : 1;
  s->masses = static_cast<Said>(DrawIndex({0.45, 0.25, 0.3}, rng));
  s->decimals = static_cast<int>(DrawValue({{2, 8}, {3, 22}, {4, 30}, {5, 10}, {6, 30}}, rng));
  s->test_rows = Chance(0.4, rng);
  s->directions = Chance(0.3, rng);
  s->payload_varies = Chance(0.2, rng);
}

void DrawRows(Settings* s, Rng* rng) {
  s->rows = static_cast<int>(
      DrawValue({{60, 8}, {100, 14}, {150, 20}, {200, 22}, {300, 18}, {400, 16}, {2000, 2}}, rng));
  s->order = static_cast<Order>(DrawIndex({0.6, 0.15, 0.15, 0.1}, rng));
  s->repeats = static_cast<int>(DrawValue({{1, 0.86}, {3, 0.08}, {10, 0.06}}, rng));
  s->repeats_share = Chance(0.5, rng);
  s->targets = static_cast<int>(DrawValue({{1, 0.75}, {2, 0.12}, {3, 0.13}}, rng));
  const bool several = Chance(0.25, rng);
  s->runs = several ? 2 + DrawInt(2, rng) : 1;
  s->setups = several ? static_cast<Setups>(DrawInt(3, rng)) : Setups::kOne;
  s->clock = Chance(0.85, rng);
}

/// What does not go together, or shows nothing at all, is not drawn.
void Reconcile(Settings* s, Rng* rng) {
  if (s->robot == "scara") s->kind = Kind::kPosition;
  if (s->kind == Kind::kDistance) {
    // One number a row: the rows drawn alone hold the geometry.
    s->complete = true;
    s->rows = std::max(s->rows, 300);
  }
  if (s->kind == Kind::kAdjacent) {
    s->rows = std::max(s->rows, 150);
    s->runs = 2 + DrawInt(5, rng);
    s->targets = 1;
  }
  if (s->kind != Kind::kPosition && s->kind != Kind::kPose) {
    s->repeats = 1;
    s->setups = Setups::kOne;
  }
  if (s->repeats > 1 && s->order == Order::kStreamed) s->order = Order::kRandom;
  // Forty poses, or a third of the rows: what people with repeats measure.
  if (s->repeats == 3) s->rows = std::max(s->rows, 180);
  if (s->repeats == 10) s->rows = std::max(s->rows, 400);
  // Rows of a run hold six freedoms of its base.
  if (s->setups != Setups::kOne) s->rows = std::max(s->rows, 150);
  // `per_run` frames are unknowns, so the file frees the base.
  if (s->setups == Setups::kStated) s->complete = true;
}

}  // namespace

const char* ToString(Kind kind) {
  constexpr const char* kNames[] = {"position", "pose", "distance", "adjacent_position"};
  return kNames[static_cast<int>(kind)];
}

const char* ToString(Order order) {
  constexpr const char* kNames[] = {"random", "sorted", "streamed", "grid"};
  return kNames[static_cast<int>(order)];
}

const char* ToString(Tail tail) {
  constexpr const char* kNames[] = {"gaussian", "student", "mixed"};
  return kNames[static_cast<int>(tail)];
}

const char* ToString(Said said) {
  constexpr const char* kNames[] = {"given", "wrong", "missing"};
  return kNames[static_cast<int>(said)];
}

const char* ToString(Setups setups) {
  constexpr const char* kNames[] = {"one", "stated", "forgotten"};
  return kNames[static_cast<int>(setups)];
}

Settings DrawSettings(Rng* rng) {
  const std::vector<std::string> robots = {"kr15", "ur10", "small", "modified", "seven", "scara"};
  Settings settings;
  settings.robot = robots[DrawIndex({0.2, 0.15, 0.12, 0.25, 0.18, 0.1}, rng)];
  DrawReadings(&settings, rng);
  DrawFile(&settings, rng);
  DrawRows(&settings, rng);
  Reconcile(&settings, rng);
  return settings;
}

Arm DrawArm(const Settings& settings, Rng* rng) {
  const std::string& name = settings.robot;
  Arm arm = name == "kr15"       ? KukaKr15()
            : name == "ur10"     ? UniversalUr10()
            : name == "small"    ? SmallArm()
            : name == "modified" ? ModifiedSix()
            : name == "seven"    ? SevenAxes()
                                 : Scara();
  arm.noise = settings.noise;
  if (settings.far) {
    // Levelled instruments turn about the vertical only.
    const Eigen::Vector3d away(rng->Uniform(2, 5), rng->Uniform(-3, 3), rng->Uniform(-1.5, 0));
    const double heading = rng->Uniform(-kPi, kPi);
    arm.base = Displacement(heading * Eigen::Vector3d::UnitZ(), away);
  }
  for (int k = 0; settings.targets > 1 && k < settings.targets; ++k) {
    const double angle = 2 * kPi * k / settings.targets;
    const Eigen::Vector3d around(0.08 * std::cos(angle), 0.08 * std::sin(angle), 0.03 * k);
    arm.targets.push_back(arm.tool * Eigen::Translation3d(around));
  }
  return arm;
}

}  // namespace dhcal::concealed
