// Missing freedom of the geometry: the tilt between two nominally parallel axes.
//
//   d beta_i = b                             b [rad], Hayati's angle
//
// Plain DH rows have no parameter for it (Hayati 1983); left out, it looks like physics.
// Typical: 0.1-0.5 mrad. Source: physics.md X1. Geometry, not physics: named first.
// Worked number: b = 0.3 mrad adds 0.3 mrad to beta2 in every row.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/joint_effect.h"

namespace dhcal {
namespace {

class AxisTiltEffect final : public JointEffect {
 public:
  AxisTiltEffect() : JointEffect(About(), {EffectClass::kGeometry, DriverKind::kConstant}) {}

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    return {SlotColumn("tilt",
                       "rad",
                       3e-4,
                       c.slots().joint(JointIndex(request), JointSlot::kBeta),
                       Eigen::VectorXd::Ones(c.num_rows()))};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& /*c*/) const override { return {}; }
  std::string Sentence(const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the axis after joint {} is tilted by {} against parallel",
                       request.joint,
                       Quantity(Find(values, "tilt"), 1e-3, "mrad"));
  }
  WorkedExample Example() const override {
    return {WithValue(Request(2), "tilt", 3e-4), 1, "beta2", 3e-4};
  }

 private:
  static EffectDescription About() {
    EffectDescription d{
        "axis_tilt",
        "two axes that the drawing says are parallel are not (geometry, not physics)",
        "beta_i += b",
        "tilt [rad]",
        {},
        "",
        "0.1-0.5 mrad [physics.md X1]"};
    d.completes = ParameterGroup::kBeta;
    return d;
  }
};

}  // namespace

const Effect& AxisTilt() {
  static const AxisTiltEffect effect;
  return effect;
}

}  // namespace dhcal
