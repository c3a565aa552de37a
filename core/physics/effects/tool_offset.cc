// Missing freedom of the geometry: the tool frame that the file holds fixed.
//
//   tool_xyz += (x, y, z) [m],  tool_rxyz += (rx, ry, rz) [rad]
//
// Left out, it looks like physics. Typical: 0.1-10 mm. Source: physics.md X1, D19. Geometry, not
// physics: named first.
// Worked number: z = 2 mm adds 2 mm to tool_z in every row.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"

namespace dhcal {
namespace {

const char* const kNames[] = {"x", "y", "z", "rx", "ry", "rz"};

class ToolOffsetEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{"tool_offset",
                        "the measured point lies elsewhere on the flange than the file says "
                        "(geometry, not physics)",
                        "tool_xyz += (x, y, z), tool_rxyz += (rx, ry, rz)",
                        "x, y, z [m], rx, ry, rz [rad]",
                        {},
                        "",
                        "0.1-10 mm [physics.md X1]"};
    d.has_joint = false;
    return d;
  }
  std::string NotTestable(const PhysicsContext& /*c*/,
                          const EffectRequest& /*request*/) const override {
    return "";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& /*request*/) const override {
    std::vector<EffectColumn> columns;
    for (int k = 0; k < SlotLayout::kPerFrame; ++k) {
      columns.push_back(SlotColumn(kNames[k],
                                   k < 3 ? "m" : "rad",
                                   1e-3,
                                   c.slots().tool(k),
                                   Eigen::VectorXd::Ones(c.num_rows())));
    }
    return columns;
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& /*c*/) const override { return {}; }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"geometry", "tool", "constant"};
  }
  std::string Sentence(const EffectRequest& /*request*/,
                       const std::vector<EffectValue>& values) const override {
    std::string text = "the measured point lies elsewhere on the flange than the file says:";
    for (int k = 0; k < SlotLayout::kPerFrame; ++k) {
      const EffectValue value = Find(values, kNames[k]);
      if (!(value.sigma > 0)) continue;
      text += fmt::format(" {} {},", kNames[k], Quantity(value, 1e-3, k < 3 ? "mm" : "mrad"));
    }
    text.pop_back();
    return text;
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "tool_offset";
    example.request.values["z"] = 2e-3;
    example.row = 1;
    example.slot = "tool_z";
    example.expected = 2e-3;
    return example;
  }
};

}  // namespace

const Effect& ToolOffset() {
  static const ToolOffsetEffect effect;
  return effect;
}

}  // namespace dhcal
