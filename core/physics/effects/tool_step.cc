// Sudden change of the tool: the reflector or gripper slipped.
//
//   tool_xyz += (x, y, z) H(t - t0)          [m], in the flange's axes; t0 = setting at_s or at_row
//
// Without orientations a slip sideways and a step of the last joint are the same.
// Typical: 0.05-0.5 mm. Source: PHYSICS.md T3. Found by scanning t0.
// Worked number: x = 0.1 mm at 3600 s: 0 before, 0.1 mm from row 1 on.
#include <fmt/format.h>

#include "core/kinematics/slots.h"
#include "core/physics/columns.h"
#include "core/physics/step.h"

namespace dhcal {
namespace {

class ToolStepEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{"tool_step",
                        "the measured point jumps once against the flange",
                        "tool_xyz += (x, y, z) H(t - t0)",
                        "x, y, z [m]",
                        {{"at_s", "instant on the clock"}, {"at_row", "instant without a clock"}},
                        "",
                        "0.05-0.5 mm [PHYSICS.md T3]"};
    d.has_joint = false;
    return d;
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    return StepNotTestable(c, request);
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    return FrameColumns(c.slots().tool(0), 3, 1e-4, StepProfile(c, request));
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    EffectRequest request;
    request.effect = "tool_step";
    return StepCandidates(c, {request});
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"C6", "tool", "time"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the tool slips {}: {}", StepWords(request), ComponentsInWords(values, 3));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "tool_step";
    example.request.settings["at_s"] = 3600;
    example.request.values["x"] = 1e-4;
    example.row = 1;
    example.slot = "tool_x";
    example.expected = 1e-4;
    return example;
  }
};

}  // namespace

const Effect& ToolStep() {
  static const ToolStepEffect effect;
  return effect;
}

}  // namespace dhcal
