// Sudden change of the tool: the reflector or gripper slipped.
//
//   tool_xyz += (x, y, z) H(t - t0)          [m], in the flange's axes; t0 = setting at_s or at_row
//
// Without orientations a slip sideways and a step of the last joint are the same.
// Typical: 0.05-0.5 mm. Source: physics.md T3. Found by scanning t0.
// Worked number: x = 0.1 mm at 3600 s: 0 before, 0.1 mm from row 1 on.
#include <cmath>

#include <fmt/format.h>

#include "core/kinematics/slots.h"
#include "core/physics/columns.h"
#include "core/physics/step.h"

namespace dhcal {
namespace {

class ToolStepEffect final : public Effect {
 public:
  ToolStepEffect()
      : Effect({"tool_step",
                "the measured point jumps once against the flange",
                "tool_xyz += (x, y, z) H(t - t0)",
                "x, y, z [m]",
                InstantSettings(),
                "",
                "0.05-0.5 mm [physics.md T3]"}) {}

  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    return StepNotTestable(c, request);
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    std::vector<EffectColumn> columns;
    for (int k = 0; k < 3; ++k) {
      columns.push_back(SlotColumn(
          SlotLayout::ComponentName(k), "m", 1e-4, c.slots().tool(k), StepProfile(c, request)));
    }
    return columns;
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    return StepCandidates(c, {Request()});
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {EffectClass::kStep, "tool", {DriverKind::kTime}};
  }
  std::string Sentence(const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    std::string text = fmt::format("the tool slips {}: ", StepWords(request));
    for (int k = 0; k < 3; ++k) {
      text += fmt::format("{}{} {}",
                          k > 0 ? ", " : "",
                          SlotLayout::ComponentName(k),
                          Quantity(Find(values, SlotLayout::ComponentName(k)), 1e-3, "mm"));
    }
    return text;
  }
  WorkedExample Example() const override {
    return {WithValue(WithSetting(Request(), "at_s", 3600), "x", 1e-4), 1, "tool_x", 1e-4};
  }
};

}  // namespace

const Effect& ToolStep() {
  static const ToolStepEffect effect;
  return effect;
}

}  // namespace dhcal
