// Wrong transmission ratio of a joint: the error grows with the angle.
//
//   d theta_j = g q_j                        g [rad/rad] (m/m for a prismatic joint)
//
// Same sense as the joint counts: g > 0 turns farther than asked.
// Typical: 1e-4-1e-3 where a ratio was entered wrongly. Source: physics.md K1.
// Worked number: g = 1e-4 at q = 30 deg (0.5236 rad) adds 52.36 urad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/joint_effect.h"

namespace dhcal {
namespace {

class JointGainEffect final : public JointEffect {
 public:
  JointGainEffect()
      : JointEffect({"joint_gain",
                     "a joint turns by a constant factor more or less than the controller says",
                     "d theta_j = g q_j",
                     "gain [rad/rad]",
                     {},
                     "",
                     "0.1-1 mrad/rad [physics.md K1]"},
                    {EffectClass::kJointAngle,
                     DriverKind::kJointAngle,
                     JointNeeds::kMotion,
                     /*tries_sliding=*/true}) {}

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    return {SlotColumn("gain", "rad/rad", 1e-4, c.joint_slot(joint), c.q(joint))};
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& request) const override {
    return {SmoothInAngleOf(request.joint),
            JointName(request.joint),
            {DriverKind::kJointAngle, request.joint}};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }
  std::string Sentence(const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("joint {} turns by a constant factor too far: {}",
                       request.joint,
                       Quantity(Find(values, "gain"), 1e-3, "mrad per rad"));
  }
  WorkedExample Example() const override {
    return {WithValue(Request(3), "gain", 1e-4), 1, "theta3", 1e-4 * 0.523598775598299};
  }
};

}  // namespace

const Effect& JointGain() {
  static const JointGainEffect effect;
  return effect;
}

}  // namespace dhcal
