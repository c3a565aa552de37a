// Causes that gravity loads.
#include <algorithm>
#include <vector>

#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/random/cause_sources.h"
#include "tools/proof/simulator/random/draw.h"

namespace dhcal::concealed {

std::vector<CauseSource> SourcesOfLoads(const Subject& subject) {
  const bool loaded = !subject.loaded.empty();
  // Joint 2 carries the spring; the one that carries no load has no use for it.
  const bool lifts =
      std::find(subject.loaded.begin(), subject.loaded.end(), 2) != subject.loaded.end();
  return {{4,
           loaded,
           [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.loaded, rng);
             return Causes{Yields(joint, strength * of.UsualCompliance(joint))};
           }},
          {1,
           loaded,
           [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.loaded, rng);
             const double soft = of.RangeOfTorque(joint) * rng->Uniform(0.05, 0.3);
             return Causes{YieldsSoftly(joint, strength * of.UsualCompliance(joint), soft)};
           }},
          {1,
           lifts,
           [](const Subject& of, double strength, Rng* rng) {
             // A spring that carries some tens of per cent of gravity's torque of a KR 15.
             const double stiffness = 4e3 * of.trial.drawing.links[0].mass / 60;
             Cause spring = Balanced(stiffness * rng->Uniform(0.5, 1.5));
             spring.also.emplace_back("transmission_error");
             return Causes{Yields(2, strength * of.UsualCompliance(2)), spring};
           }},
          {1,
           loaded && !subject.beams.empty(),
           [](const Subject& of, double strength, Rng* rng) {
             return Causes{LinkBends(DrawFrom(of.beams, rng), strength * 1e-6)};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* /*rng*/) {
             return Causes{BaseYields(strength * of.trial.drawing.base_compliance)};
           }},
          {1, loaded, [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.loaded, rng);
             // As of a KR 15's second joint: near zero torque the approach decides.
             const double preload = 0.015 * of.RangeOfTorque(joint);
             return Causes{PlaysUnderLoad(joint, strength * 1e-4, preload)};
           }}};
}

}  // namespace dhcal::concealed
