// Missing freedom of the geometry: the tilt between two nominally parallel axes.
//
//   d beta_i = b                             b [rad], Hayati's angle
//
// Plain DH rows have no parameter for it (Hayati 1983); left out, it looks like physics.
// Typical: 0.1-0.5 mrad. Source: PHYSICS.md X1. Geometry, not physics: named first.
// Worked number: b = 0.3 mrad adds 0.3 mrad to beta2 in every row.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"

namespace dhcal {
namespace {

class AxisTiltEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"axis_tilt",
            "two axes that the drawing says are parallel are not (geometry, not physics)",
            "beta_i += b",
            "tilt [rad]",
            {},
            "",
            "0.1-0.5 mrad [PHYSICS.md X1]"};
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    return CheckJoint(c, request);
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    return {SlotColumn("tilt",
                       "rad",
                       3e-4,
                       c.slots().joint(JointIndex(request), JointSlot::kBeta),
                       Eigen::VectorXd::Ones(c.num_rows()))};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& /*c*/) const override { return {}; }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& request) const override {
    return {"geometry", JointName(request.joint), "constant"};
  }
  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the axis after {} is tilted by {} against parallel",
                       JointWords(context, request.joint),
                       Quantity(Find(values, "tilt"), 1e-3, "mrad"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "axis_tilt";
    example.request.joint = 2;
    example.request.values["tilt"] = 3e-4;
    example.row = 1;
    example.slot = "beta2";
    example.expected = 3e-4;
    return example;
  }
};

}  // namespace

const Effect& AxisTilt() {
  static const AxisTiltEffect effect;
  return effect;
}

}  // namespace dhcal
