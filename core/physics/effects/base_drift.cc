// Slow motion of the base against the instrument: room, floor or tracker warm up.
//
//   base_x += x u,  base_y += y u,  base_z += z u        [m]
//
// u: the course of a drift (core/physics/drift.h). Adjacent differences hardly see it.
// Typical: 0.05-0.3 mm over a warm-up. Source: PHYSICS.md T2.
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
  EffectDescription Describe() const override {
    EffectDescription d{"base_drift",
                        "base or instrument moves slowly during the recording",
                        "base_xyz += (x, y, z) u",
                        "x, y, z [m], or [m/K] with temperatures",
                        {{"time_constant_s", "by the clock; 0 = steadily"}},
                        "temperature_C, or t_s with time_constant_s",
                        "0.05-0.3 mm over a warm-up [PHYSICS.md T2]"};
    d.has_joint = false;
    return d;
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (c.robot().base_per_edge) return kFrameOfEdges;
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
    EffectRequest request;
    request.effect = "base_drift";
    return DriftCandidates(c, {request});
  }
  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    return {"C5", "base", DriftByTime(c, request) ? "time" : "temperature"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const bool clock = request.settings.count("time_constant_s") > 0;
    return fmt::format("base or instrument moves{}: {}",
                       DriftWords(request),
                       ComponentsInWords(values, 3, clock ? "mm" : "mm per K"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "base_drift";
    example.request.values["z"] = 1e-4;
    example.row = 1;
    example.slot = "base_z";
    example.expected = 1e-3;
    return example;
  }
};

}  // namespace

const Effect& BaseDrift() {
  static const BaseDriftEffect effect;
  return effect;
}

}  // namespace dhcal
