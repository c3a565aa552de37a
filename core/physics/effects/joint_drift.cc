// Slow drift of a joint's zero: a gearbox or encoder warms up.
//
//   d theta_j = r u                          r [rad], or [rad/K] with temperatures
//
// u: the course of a drift (core/physics/drift.h).
// Typical: 0.05-0.3 mrad. Source: PHYSICS.md T1 (gearbox-heated parts).
// Worked number: r = 0.2 mrad, T = 3600 s, t = 3600 s: 0.2 (1 - 1/e) = 0.1264 mrad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/drift.h"

namespace dhcal {
namespace {

class JointDriftEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"joint_drift",
            "a joint's zero moves slowly during the recording",
            "d theta_j = r u",
            "drift [rad], of a slide [m]; with temperatures per K",
            {{"time_constant_s", "by the clock; 0 = steadily"}},
            "temperature_C, or t_s with time_constant_s",
            "0.05-0.3 mrad [PHYSICS.md T1]"};
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    return DriftNotTestable(c, request, JointIndex(request));
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    const bool clock = DriftByTime(c, request);
    return {SlotColumn("drift",
                       fmt::format("{}{}", c.revolute(joint) ? "rad" : "m", clock ? "" : "/K"),
                       clock ? 1e-4 : 1e-5,
                       c.joint_slot(joint),
                       DriftProfile(c, request, joint))};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    return DriftCandidates(c, EveryJoint(c, "joint_drift", /*revolute_only=*/false));
  }
  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    return {"C5", JointName(request.joint), DriftByTime(c, request) ? "time" : "temperature"};
  }
  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const EffectValue drift = Find(values, "drift");
    return fmt::format("the zero of {} drifts{} by {}",
                       JointWords(context, request.joint),
                       DriftWords(request),
                       AmountOfJoint(drift));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "joint_drift";
    example.request.joint = 3;
    example.request.settings["time_constant_s"] = 3600;
    example.request.values["drift"] = 2e-4;
    example.row = 1;
    example.slot = "theta3";
    example.expected = 2e-4 * 0.632120558828558;
    return example;
  }
};

}  // namespace

const Effect& JointDrift() {
  static const JointDriftEffect effect;
  return effect;
}

}  // namespace dhcal
