// Spring or counterweight at the shoulder: a torque that depends on the shoulder's angle alone.
//
//   d theta_j = s1 sin q + c1 cos q + s2 sin 2q + c2 cos 2q      [rad]
//
// A spring between column and link acts with k (l - l0) a b sin(q + phi) / l(q), times the joint's
// compliance; of its five numbers an amplitude and two of shape can be found, which the first two
// harmonics hold. It does not change with payload, unlike compliance.
// Typical: 20-60 % of the gravity torque of joint 2, 0.1 mm. Source: PHYSICS.md E2 (Dzubba 2025).
// Worked number: s1 = 0.2 mrad at q = 30 deg adds 0.1 mrad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/gravity.h"

namespace dhcal {
namespace {

class GravityBalancerEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"gravity_balancer",
            "a spring or gas balancer acts on the joint that lifts the arm",
            "d theta_j = s1 sin q + c1 cos q + s2 sin 2q + c2 cos 2q",
            "sin_1, cos_1, sin_2, cos_2 [rad]",
            {},
            "a turning joint that gravity loads",
            "0.1-0.3 mrad [PHYSICS.md E2]"};
  }

  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    if (!c.revolute(JointIndex(request))) return "the joint is prismatic";
    return c.moves(JointIndex(request)) ? "" : "the joint does not move";
  }

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    const Eigen::ArrayXd q = c.q(joint).array();
    const int slot = c.joint_slot(joint);
    return {SlotColumn("sin_1", "rad", kTypical, slot, q.sin().matrix()),
            SlotColumn("cos_1", "rad", kTypical, slot, q.cos().matrix()),
            SlotColumn("sin_2", "rad", kTypical, slot, (2 * q).sin().matrix()),
            SlotColumn("cos_2", "rad", kTypical, slot, (2 * q).cos().matrix())};
  }

  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    const int joint = FirstLoadedJoint(c);
    if (joint < 0) return {};
    EffectRequest request;
    request.effect = "gravity_balancer";
    request.joint = joint + 1;
    return {request};
  }

  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& request) const override {
    return {"C2", JointName(request.joint), "joint angle"};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }

  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format(
        "{} is turned by a torque that depends on its own angle alone (typical of a gravity "
        "balancer): {} at one cycle and {} at two cycles per revolution",
        JointWords(context, request.joint),
        Quantity(Amplitude(Find(values, "sin_1"), Find(values, "cos_1")), 1e-3, "mrad"),
        Quantity(Amplitude(Find(values, "sin_2"), Find(values, "cos_2")), 1e-3, "mrad"));
  }

  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "gravity_balancer";
    example.request.joint = 3;
    example.request.values["sin_1"] = 2e-4;
    example.row = 1;
    example.slot = "theta3";
    example.expected = 1e-4;
    return example;
  }

 private:
  static constexpr double kTypical = 1e-4;  // [rad]
};

}  // namespace

const Effect& GravityBalancer() {
  static const GravityBalancerEffect effect;
  return effect;
}

}  // namespace dhcal
