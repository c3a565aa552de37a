// Slow drift of a joint's zero: a gearbox or encoder warms up.
//
//   d theta_j = r u                          r [rad], or [rad/K] with temperatures
//
// u: the course of a drift (core/physics/drift.h).
// Typical: 0.05-0.3 mrad. Source: physics.md T1 (gearbox-heated parts).
// Worked number: r = 0.2 mrad, T = 3600 s, t = 3600 s: 0.2 (1 - 1/e) = 0.1264 mrad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/drift.h"
#include "core/physics/joint_effect.h"

namespace dhcal {
namespace {

class JointDriftEffect final : public JointEffect {
 public:
  JointDriftEffect()
      : JointEffect({"joint_drift",
                     "a joint's zero moves slowly during the recording",
                     "d theta_j = r u",
                     "drift [rad], or [rad/K] with temperatures",
                     {TimeConstantSetting()},
                     "temperature_C, or t_s with time_constant_s",
                     "0.05-0.3 mrad [physics.md T1]"},
                    {EffectClass::kDrift, DriverKind::kTime}) {}

  std::string NotTestableAt(const PhysicsContext& c, const EffectRequest& request) const override {
    return DriftNotTestable(c, request, JointIndex(request));
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    const bool clock = DriftByTime(c, request);
    return {SlotColumn("drift",
                       clock ? "rad" : "rad/K",
                       clock ? 1e-4 : 1e-5,
                       c.joint_slot(joint),
                       DriftProfile(c, request, joint))};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    return DriftCandidates(c, EveryJoint(c));
  }
  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    return {EffectClass::kDrift, JointName(request.joint), DriftDriver(c, request)};
  }
  std::string Sentence(const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const bool clock = request.settings.count("time_constant_s") > 0;
    return fmt::format("the zero of joint {} drifts{} by {}",
                       request.joint,
                       DriftWords(request),
                       Quantity(Find(values, "drift"), 1e-3, clock ? "mrad" : "mrad per K"));
  }
  WorkedExample Example() const override {
    return {WithValue(WithSetting(Request(3), "time_constant_s", 3600), "drift", 2e-4),
            1,
            "theta3",
            2e-4 * 0.632120558828558};
  }
};

}  // namespace

const Effect& JointDrift() {
  static const JointDriftEffect effect;
  return effect;
}

}  // namespace dhcal
