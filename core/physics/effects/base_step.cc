// Sudden change of the base or of the instrument: somebody bumped one of them.
//
//   base_xyz += (x, y, z) H(t - t0)          [m], in W; t0 = setting at_s or at_row
//   base_rxyz += (rx, ry, rz) H(t - t0)      [rad]
//
// Readings of one instrument do not say which of the two moved.
// Typical: 0.05-0.5 mm. Source: PHYSICS.md T3. Found by scanning t0.
// Worked number: x = 0.1 mm at 3600 s: 0 before, 0.1 mm from row 1 on.
#include <fmt/format.h>

#include "core/kinematics/slots.h"
#include "core/physics/columns.h"
#include "core/physics/step.h"

namespace dhcal {
namespace {

class BaseStepEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{"base_step",
                        "base or instrument jumps once, as if bumped",
                        "base += (x, y, z, rx, ry, rz) H(t - t0)",
                        "x, y, z [m], rx, ry, rz [rad]",
                        {{"at_s", "instant on the clock"}, {"at_row", "instant without a clock"}},
                        "",
                        "0.05-0.5 mm [PHYSICS.md T3]"};
    d.has_joint = false;
    return d;
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (c.robot().base_per_edge) return kFrameOfEdges;
    return StepNotTestable(c, request);
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    return FrameColumns(c.slots().base(0), SlotLayout::kPerFrame, 1e-4, StepProfile(c, request));
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    EffectRequest request;
    request.effect = "base_step";
    return StepCandidates(c, {request});
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"C6", "base", "time"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("base or instrument jumps {}: {}",
                       StepWords(request),
                       ComponentsInWords(values, SlotLayout::kPerFrame));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "base_step";
    example.request.settings["at_s"] = 3600;
    example.request.values["x"] = 1e-4;
    example.row = 1;
    example.slot = "base_x";
    example.expected = 1e-4;
    return example;
  }
};

}  // namespace

const Effect& BaseStep() {
  static const BaseStepEffect effect;
  return effect;
}

}  // namespace dhcal
