// One joint's motion turns another: a wrist's coupled bevel gears, a parallelogram.
//
//   d theta_j = k q_i                        k [rad/rad], i = driver_joint (setting)
//
// The controller compensates couplings with nominal ratios; k is what is left.
// Typical: 1e-4-1e-3 where a ratio is wrong. Source: PHYSICS.md W1.
// Worked number: k = 2e-4 of joint 4 at 40 deg (0.6981 rad) turns joint 5 by 139.6 urad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"

namespace dhcal {
namespace {

class JointCouplingEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"joint_coupling",
            "a joint is turned by the motion of another one",
            "d theta_j = k q_i",
            "coupling [rad/rad]",
            {{"driver_joint", "i; default: the joint before j"}},
            "a second joint that moves",
            "0.1-1 mrad/rad [PHYSICS.md W1]"};
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    const int driver = Driver(request);
    if (driver < 0 || driver >= c.num_joints() || driver == JointIndex(request)) {
      return fmt::format("needs another joint from 1 to {} as driver_joint", c.num_joints());
    }
    return c.moves(driver) ? "" : "the driving joint does not move";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const auto si = [&](int joint) { return std::string(c.revolute(joint) ? "rad" : "m"); };
    const std::string unit = si(JointIndex(request)) + "/" + si(Driver(request));
    return {SlotColumn(
        "coupling", unit, 2e-4, c.joint_slot(JointIndex(request)), c.q(Driver(request)))};
  }
  /// Couplings of the last three joints, and of the third by the second (a parallelogram).
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    std::vector<EffectRequest> requests;
    const int n = c.num_joints();
    const auto add = [&](int driver, int joint) {
      if (driver < 1 || joint > n) return;
      EffectRequest request;
      request.effect = "joint_coupling";
      request.joint = joint;
      request.settings["driver_joint"] = driver;
      requests.push_back(request);
    };
    if (n >= 6) add(2, 3);
    add(n - 2, n - 1);
    add(n - 2, n);
    add(n - 1, n);
    return requests;
  }
  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    return {request.joint > c.num_joints() - 3 ? "C9" : "coupling",
            JointName(request.joint),
            fmt::format("angle of joint {}", Driver(request) + 1)};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }
  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const EffectValue coupling = Find(values, "coupling");
    // The unit says which of the two slides: "m/rad" -> "mm per rad".
    const std::size_t slash = coupling.unit.find('/');
    return fmt::format("{} is {} by {}: {}",
                       JointWords(context, request.joint),
                       coupling.unit.substr(0, slash) == "m" ? "moved" : "turned",
                       JointWords(context, Driver(request) + 1),
                       Quantity(coupling,
                                1e-3,
                                fmt::format("m{} per {}",
                                            coupling.unit.substr(0, slash),
                                            coupling.unit.substr(slash + 1))));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "joint_coupling";
    example.request.joint = 5;
    example.request.settings["driver_joint"] = 4;
    example.request.values["coupling"] = 2e-4;
    example.row = 1;
    example.slot = "theta5";
    example.expected = 2e-4 * 0.698131700797732;
    return example;
  }

 private:
  static int Driver(const EffectRequest& request) {
    return static_cast<int>(request.setting("driver_joint", request.joint - 1)) - 1;
  }
};

}  // namespace

const Effect& JointCoupling() {
  static const JointCouplingEffect effect;
  return effect;
}

}  // namespace dhcal
