// Sudden change of a joint's zero: a remastering, a slipped belt or encoder, a collision.
//
//   d theta_j = s H(t - t0)                  s [rad]; t0 = setting at_s or at_row
//
// Typical: 0.1-1 mrad. Source: PHYSICS.md T3. Found by scanning t0.
// Worked number: s = 0.2 mrad at 3600 s: 0 before, 0.2 mrad from row 1 on.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/step.h"

namespace dhcal {
namespace {

class JointStepEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"joint_step",
            "a joint's zero jumps once during the recording",
            "d theta_j = s H(t - t0)",
            "step [rad], of a slide [m]",
            {{"at_s", "instant on the clock"}, {"at_row", "instant without a clock"}},
            "",
            "0.1-1 mrad [PHYSICS.md T3]"};
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    return StepNotTestable(c, request);
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    return {SlotColumn("step",
                       c.revolute(joint) ? "rad" : "m",
                       2e-4,
                       c.joint_slot(joint),
                       StepProfile(c, request))};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    return StepCandidates(c, EveryJoint(c, "joint_step", /*revolute_only=*/false));
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& request) const override {
    return {"C6", JointName(request.joint), "time"};
  }
  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the zero of {} jumps by {} {}",
                       JointWords(context, request.joint),
                       AmountOfJoint(Find(values, "step")),
                       StepWords(request));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "joint_step";
    example.request.joint = 3;
    example.request.settings["at_s"] = 3600;
    example.request.values["step"] = 2e-4;
    example.row = 1;
    example.slot = "theta3";
    example.expected = 2e-4;
    return example;
  }
};

}  // namespace

const Effect& JointStep() {
  static const JointStepEffect effect;
  return effect;
}

}  // namespace dhcal
