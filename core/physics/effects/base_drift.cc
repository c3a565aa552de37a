// Slow motion of the base against the instrument: room, floor or tracker warm up.
//
//   base_x += x u,  base_y += y u,  base_z += z u        [m]
//
// u: the course of a drift (core/physics/drift.h). Adjacent differences hardly see it.
// Typical: 0.05-0.3 mm over a warm-up. Source: physics.md T2.
// Worked number: z = 0.1 mm/K at +10 K: +1 mm.
#include <cmath>

#include <fmt/format.h>

#include "core/kinematics/slots.h"
#include "core/physics/columns.h"
#include "core/physics/drift.h"

namespace dhcal {
namespace {

class BaseDriftEffect final : public Effect {
 public:
  BaseDriftEffect()
      : Effect({"base_drift",
                "base or instrument moves slowly during the recording",
                "base_xyz += (x, y, z) u",
                "x, y, z [m], or [m/K] with temperatures",
                {TimeConstantSetting()},
                "temperature_C, or t_s with time_constant_s",
                "0.05-0.3 mm over a warm-up [physics.md T2]"}) {}

  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    return DriftNotTestable(c, request, 0);
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const Eigen::VectorXd u = DriftProfile(c, request, 0);
    const bool clock = DriftByTime(c, request);
    std::vector<EffectColumn> columns;
    for (int k = 0; k < 3; ++k) {
      columns.push_back(SlotColumn(SlotLayout::ComponentName(k),
                                   clock ? "m" : "m/K",
                                   clock ? 1e-4 : 1e-5,
                                   c.slots().base(k),
                                   u));
    }
    return columns;
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    return DriftCandidates(c, {Request()});
  }
  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    return {EffectClass::kDrift, "base", DriftDriver(c, request)};
  }
  std::string Sentence(const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const bool clock = request.settings.count("time_constant_s") > 0;
    std::string text = fmt::format("base or instrument moves{}: ", DriftWords(request));
    for (int k = 0; k < 3; ++k) {
      text += fmt::format(
          "{}{} {}",
          k > 0 ? ", " : "",
          SlotLayout::ComponentName(k),
          Quantity(Find(values, SlotLayout::ComponentName(k)), 1e-3, clock ? "mm" : "mm per K"));
    }
    return text;
  }
  WorkedExample Example() const override {
    return {WithValue(Request(), "z", 1e-4), 1, "base_z", 1e-3};
  }
};

}  // namespace

const Effect& BaseDrift() {
  static const BaseDriftEffect effect;
  return effect;
}

}  // namespace dhcal
