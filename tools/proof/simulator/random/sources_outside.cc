// Causes of no library.
#include <vector>

#include "core/base/units.h"
#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/random/cause_sources.h"
#include "tools/proof/simulator/random/draw.h"

namespace dhcal::concealed {
namespace {

/// A curve of the joint's own angle, as transmission_error draws it; where a single line of it does
/// for such readings, gear_harmonic says the same. So does friction of a joint that moves one way.
Cause CurveOfJoint(Cause cause) {
  cause.also = {"transmission_error", "gear_harmonic"};
  return cause;
}

}  // namespace

std::vector<CauseSource> SourcesOutside(const Subject& /*subject*/) {
  return {{1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.turning, rng);
             const double at = of.trial.drawing.middle[joint - 1] +
                               0.5 * of.trial.drawing.wide[joint - 1] * rng->Uniform(-1, 1);
             const double width = rng->Uniform(15, 40) * kDegree;
             return Causes{CurveOfJoint(ToothDamaged(joint, at, width, strength * 1e-4))};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.turning, rng);
             const double at = of.trial.drawing.middle[joint - 1] +
                               0.4 * of.trial.drawing.wide[joint - 1] * rng->Uniform(-1, 1);
             return Causes{CurveOfJoint(Kinked(joint, at, DrawSign(rng) * strength * 1e-4))};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.turning, rng), first = DrawOther(of.turning, joint, rng);
             int second = first;
             while (second == first || second == joint) second = DrawFrom(of.turning, rng);
             return Causes{CablePulls(joint, first, second, DrawSign(rng) * strength * 1e-4)};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.turning, rng), first = DrawOther(of.turning, joint, rng);
             return Causes{CableTautens(
                 joint, first, joint, rng->Uniform(-0.5, 0.8), DrawSign(rng) * strength * 2e-4)};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const double period = of.duration() / rng->Uniform(3, 12);
             return Causes{FloorSways(strength * 0.3e-4 * DrawDirection(rng), period)};
           }},
          {1, true, [](const Subject& of, double strength, Rng* rng) {
             const double order = 1.0 + DrawInt(3, rng);
             const int joint = DrawFrom(of.turning, rng);
             const Cause cause = RubsByAngle(joint, strength * 0.5e-4, order, DrawPhase(rng));
             const bool one_way = joint == 1 && of.trial.settings.order == Order::kSorted;
             return Causes{one_way ? CurveOfJoint(cause) : cause};
           }}};
}

}  // namespace dhcal::concealed
