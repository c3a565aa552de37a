// Wrong transmission ratio of a joint: the error grows with the angle.
//
//   d theta_j = g q_j                        g [rad/rad] (m/m for a prismatic joint)
//
// Same sense as the joint counts: g > 0 turns farther than asked.
// Typical: 1e-4-1e-3 where a ratio was entered wrongly. Source: PHYSICS.md K1.
// Worked number: g = 1e-4 at q = 30 deg (0.5236 rad) adds 52.36 urad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"

namespace dhcal {
namespace {

constexpr char kOfSlide[] = "m/m";

class JointGainEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"joint_gain",
            "a joint turns by a constant factor more or less than the controller says",
            "d theta_j = g q_j",
            "gain [rad/rad]",
            {},
            "",
            "0.1-1 mrad/rad [PHYSICS.md K1]"};
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    return c.moves(JointIndex(request)) ? "" : "the joint does not move";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    const char* const unit = c.revolute(joint) ? "rad/rad" : kOfSlide;
    return {SlotColumn("gain", unit, 1e-4, c.joint_slot(joint), c.q(joint))};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    return EveryJoint(c, "joint_gain", /*revolute_only=*/false);
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& request) const override {
    return {request.joint == 2 ? "C2" : "C3", JointName(request.joint), "joint angle"};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }
  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const EffectValue gain = Find(values, "gain");
    const bool slides = gain.unit == kOfSlide;
    return fmt::format("{} {} too far by a constant factor: {}",
                       JointWords(context, request.joint),
                       slides ? "slides" : "turns",
                       Quantity(gain, 1e-3, slides ? "mm per m" : "mrad per rad"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "joint_gain";
    example.request.joint = 3;
    example.request.values["gain"] = 1e-4;
    example.row = 1;
    example.slot = "theta3";
    example.expected = 1e-4 * 0.523598775598299;
    return example;
  }
};

}  // namespace

const Effect& JointGain() {
  static const JointGainEffect effect;
  return effect;
}

}  // namespace dhcal
