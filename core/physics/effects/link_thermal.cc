// Thermal growth of a link.
//
//   d a_i = e a_i u,  d d_i = e d_i u
//
// With a temperature column: u = T - T(first row) [K] and e is an expansion coefficient [1/K]
// (11e-6 steel, 23e-6 aluminium). Without: u = 1 - exp(-t/T) with the setting time_constant_s, and
// e is the strain at the end of the warm-up. A uniform temperature of robot and instrument scales
// all lengths alike, which no reading of this kind shows. Typical: 0.65 m of aluminium, 10 K: 0.15
// mm (strain 230e-6). Source: PHYSICS.md T1. Worked number: e = 20e-6 1/K, 10 K, a_2 = 0.65 m:
// +0.13 mm.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/drift.h"

namespace dhcal {
namespace {

class LinkThermalEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"link_thermal",
            "a link grows as it warms up",
            "d a_i = e a_i u, d d_i = e d_i u",
            "expansion [1/K], or strain [1] without temperatures",
            {{"time_constant_s", "by the clock; 0 = steadily"}},
            "temperature_C, or t_s with time_constant_s",
            "11-23e-6 1/K; 50-250e-6 per warm-up [PHYSICS.md T1]"};
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    const JointRow& row = c.robot().joints[static_cast<std::size_t>(JointIndex(request))];
    if (std::hypot(row.a, row.d) < 0.05) return "the link has no length";
    return DriftNotTestable(c, request, JointIndex(request));
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int link = JointIndex(request);
    const JointRow& row = c.robot().joints[static_cast<std::size_t>(link)];
    const bool clock = DriftByTime(c, request);
    const Eigen::VectorXd u = DriftProfile(c, request, link);
    EffectColumn column;
    column.parameter = clock ? "strain" : "expansion";
    column.unit = clock ? "1" : "1/K";
    column.typical = clock ? 1e-4 : 12e-6;
    column.slots.push_back({c.slots().joint(link, JointSlot::kA), row.a * u});
    column.slots.push_back({c.slots().joint(link, JointSlot::kD), row.d * u});
    return {column};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    return DriftCandidates(c, EveryJoint(c, "link_thermal", /*revolute_only=*/false));
  }
  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    return {"C5",
            fmt::format("link {}", request.joint),
            DriftByTime(c, request) ? "time" : "temperature"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const EffectValue expansion = Find(values, "expansion");
    if (expansion.sigma > 0) {
      return fmt::format("link {} grows with temperature: {}",
                         request.joint,
                         Quantity(expansion, 1e-6, "ppm per K"));
    }
    return fmt::format("link {} grows{} by {} of its length",
                       request.joint,
                       DriftWords(request),
                       Quantity(Find(values, "strain"), 1e-6, "ppm"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "link_thermal";
    example.request.joint = 2;
    example.request.values["expansion"] = 20e-6;
    example.row = 1;
    example.slot = "a2";
    example.expected = 0.13e-3;
    return example;
  }
};

}  // namespace

const Effect& LinkThermal() {
  static const LinkThermalEffect effect;
  return effect;
}

}  // namespace dhcal
