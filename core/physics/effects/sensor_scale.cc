// Scale of the instrument: every length that it reads is longer by the same factor.
//
//   reading = (1 + e) p, so base_xyz += e p_WQ           e [1]
//
// with p_WQ as the model predicts it.
//
// With free lengths, base and tool it is exactly the same as a larger robot: no reading of this
// kind shows it, and the report always says so. It can be switched on where a length is held fixed
// or a prior is given. Typical: 1-50 ppm. Source: PHYSICS.md S1. Worked number: e =
// 10 ppm at z = 1 m: +10 um.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"

namespace dhcal {
namespace {

class SensorScaleEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{"sensor_scale",
                        "the instrument's unit of length is off",
                        "base_xyz += e p_WQ",
                        "scale [1]",
                        {},
                        "",
                        "1-50 ppm [PHYSICS.md S1]; never visible with free lengths"};
    d.has_joint = false;
    d.of_instrument = true;
    d.may_be_named = false;
    return d;
  }
  std::string NotTestable(const PhysicsContext& /*c*/,
                          const EffectRequest& /*request*/) const override {
    return "";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& /*request*/) const override {
    EffectColumn column;
    column.parameter = "scale";
    column.unit = "1";
    column.typical = 1e-5;
    for (int k = 0; k < 3; ++k) {
      Eigen::VectorXd coordinate(c.num_rows());
      for (int row = 0; row < c.num_rows(); ++row) coordinate[row] = c.p_WQ(row)[k];
      column.slots.push_back({c.slots().base(k), coordinate});
    }
    return {column};
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"C7", "sensor", "distance"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& /*request*/,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the instrument reads all lengths too long by {}",
                       Quantity(Find(values, "scale"), 1e-6, "ppm"));
  }
  WorkedExample Example() const override {
    // Row 0 of the example: flange down at z = 0.675 - 0.6 - 0.14 - 0.2 = -0.265 m.
    WorkedExample example;
    example.request.effect = "sensor_scale";
    example.request.values["scale"] = 1e-5;
    example.row = 0;
    example.slot = "base_z";
    example.expected = -2.65e-6;
    return example;
  }
};

}  // namespace

const Effect& SensorScale() {
  static const SensorScaleEffect effect;
  return effect;
}

}  // namespace dhcal
