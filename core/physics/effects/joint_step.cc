// Sudden change of a joint's zero: a remastering, a slipped belt or encoder, a collision.
//
//   d theta_j = s H(t - t0)                  s [rad]; t0 = setting at_s or at_row
//
// Typical: 0.1-1 mrad. Source: physics.md T3. Found by scanning t0.
// Worked number: s = 0.2 mrad at 3600 s: 0 before, 0.2 mrad from row 1 on.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/joint_effect.h"
#include "core/physics/step.h"

namespace dhcal {
namespace {

class JointStepEffect final : public JointEffect {
 public:
  JointStepEffect()
      : JointEffect({"joint_step",
                     "a joint's zero jumps once during the recording",
                     "d theta_j = s H(t - t0)",
                     "step [rad]",
                     InstantSettings(),
                     "",
                     "0.1-1 mrad [physics.md T3]"},
                    {EffectClass::kStep, DriverKind::kTime}) {}

  std::string NotTestableAt(const PhysicsContext& c, const EffectRequest& request) const override {
    return StepNotTestable(c, request);
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    return {SlotColumn(
        "step", "rad", 2e-4, c.joint_slot(JointIndex(request)), StepProfile(c, request))};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    return StepCandidates(c, EveryJoint(c));
  }
  std::string Sentence(const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the zero of joint {} jumps by {} {}",
                       request.joint,
                       Quantity(Find(values, "step"), 1e-3, "mrad"),
                       StepWords(request));
  }
  WorkedExample Example() const override {
    return {WithValue(WithSetting(Request(3), "at_s", 3600), "step", 2e-4), 1, "theta3", 2e-4};
  }
};

}  // namespace

const Effect& JointStep() {
  static const JointStepEffect effect;
  return effect;
}

}  // namespace dhcal
