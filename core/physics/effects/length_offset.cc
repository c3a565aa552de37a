// Offset of an instrument that reads distances: every length to an anchor is too long by the same.
//
//   reading = |p_WQ - p_WA| + o, so base_xyz += u o,  u = (p_WQ - p_WA) / |p_WQ - p_WA|      o [m]
//
// for each anchor by itself: a shift of the arm along the line of sight lengthens the distance by
// exactly as much. Where a wire leaves its drum, or a tracker's home position. Typical: 0.1-20 mm.
// Source: PHYSICS.md S2. Worked number: o = 15 mm, Q right above the anchor: +15 mm upwards.
#include <string>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/columns.h"

namespace dhcal {
namespace {

class LengthOffsetEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{"length_offset",
                        "an instrument that reads distances reads all of them too long",
                        "base_xyz += u o, u from the anchor to the point",
                        "offset_<anchor> [m]",
                        {},
                        "distance_mm and anchor, measurement kind distance",
                        "0.1-20 mm [PHYSICS.md S2]"};
    d.has_joint = false;
    d.of_instrument = true;
    return d;
  }

  std::string NotTestable(const PhysicsContext& c,
                          const EffectRequest& /*request*/) const override {
    const bool reads = c.recording().distance.size() > 0 && !c.recording().anchor_idx.empty();
    if (!reads || c.robot().anchors.empty()) return "no distances to anchors are read";
    return Columns(c, {}).empty() ? "no distance is read" : "";
  }

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& /*request*/) const override {
    std::vector<EffectColumn> columns;
    for (const Anchor& anchor : c.robot().anchors) {
      EffectColumn column;
      column.parameter = "offset_" + anchor.name;
      column.unit = "m";
      column.typical = kMillimetre;
      Eigen::Matrix3Xd sight = Eigen::Matrix3Xd::Zero(3, c.num_rows());
      for (int row = 0; row < c.num_rows(); ++row) {
        if (c.anchor(row) == &anchor) {
          sight.col(row) = (c.p_WQ(row) - anchor.p_WA).normalized();
        }
      }
      if (sight.isZero(0)) continue;
      for (int k = 0; k < 3; ++k) column.slots.push_back({c.slots().base(k), sight.row(k)});
      columns.push_back(column);
    }
    return columns;
  }

  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"geometry", "sensor", "constant"};
  }

  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& /*request*/,
                       const std::vector<EffectValue>& values) const override {
    std::string text = "the instrument reads distances too long: ";
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::string anchor = values[k].parameter.substr(std::string("offset_").size());
      text += fmt::format("{}to anchor {} by {}",
                          k > 0 ? ", " : "",
                          anchor,
                          Quantity(values[k], kMillimetre, "mm"));
    }
    return text;
  }

  WorkedExample Example() const override {
    // Row 0 of the example: the point is 1 m above the anchor.
    WorkedExample example;
    example.request.effect = "length_offset";
    example.request.values["offset_A"] = 15e-3;
    example.row = 0;
    example.slot = "base_z";
    example.expected = 15e-3;
    return example;
  }
};

}  // namespace

const Effect& LengthOffset() {
  static const LengthOffsetEffect effect;
  return effect;
}

}  // namespace dhcal
