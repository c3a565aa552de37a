// Causes that a joint makes by itself or by another joint.
#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/random/cause_sources.h"
#include "tools/proof/simulator/random/draw.h"

namespace dhcal::concealed {
namespace {

/// Low orders of a gear are smooth curves, which its other names imitate over a limited range.
Cause Gear(int joint, double order, double amplitude, Rng* rng) {
  Cause cause = GearErrs(joint, order, amplitude, DrawPhase(rng));
  cause.also = {"transmission_error"};
  constexpr double kSmooth = 2.5;
  if (order < kSmooth) cause.also.insert(cause.also.end(), {"joint_gain", "gravity_balancer"});
  return cause;
}

}  // namespace

std::vector<CauseSource> SourcesOfJoints(const Subject& subject) {
  return {{2,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const double order = 1.0 + DrawInt(8, rng);
             return Causes{Gear(DrawFrom(of.turning, rng), order, strength * 1e-4, rng)};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const double order = rng->Uniform(1, 12);  // between integers, of a stage inside
             return Causes{Gear(DrawFrom(of.turning, rng), order, strength * 1e-4, rng)};
           }},
          {1,
           subject.trial.settings.order == Order::kRandom ||
               subject.trial.settings.order == Order::kSorted,
           [](const Subject& of, double strength, Rng* rng) {
             constexpr double kMost = 5;
             const double order = std::round(10 * rng->Uniform(15, 150)) / 10;
             return Causes{
                 Gear(DrawFrom(of.turning, rng), order, std::min(strength, kMost) * 0.7e-4, rng)};
           }},
          {2,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             return Causes{Plays(DrawFrom(of.turning, rng), strength * 1e-4)};
           }},
          {0.3,
           !subject.sliding.empty(),
           [](const Subject& of, double strength, Rng* rng) {
             return Causes{Plays(DrawFrom(of.sliding, rng), strength * 0.05e-3)};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             return Causes{WindsUp(DrawFrom(of.turning, rng), strength * 0.5e-4)};
           }},
          {2,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.turning, rng);
             const int driver = DrawOther(of.turning, joint, rng);
             return Causes{Coupled(joint, driver, DrawSign(rng) * strength * 2e-4)};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             return Causes{Gains(DrawFrom(of.turning, rng), DrawSign(rng) * strength * 1e-4)};
           }},
          {1, true, [](const Subject& of, double strength, Rng* rng) {
             return Causes{Wobbles(DrawFrom(of.turning, rng), strength * 3e-5, DrawPhase(rng))};
           }}};
}

}  // namespace dhcal::concealed
