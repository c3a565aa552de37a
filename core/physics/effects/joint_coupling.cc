// One joint's motion turns another: a wrist's coupled bevel gears, a parallelogram.
//
//   d theta_j = k q_i                        k [rad/rad], i = driver_joint (setting)
//
// The controller compensates couplings with nominal ratios; k is what is left.
// Typical: 1e-4-1e-3 where a ratio is wrong. Source: physics.md W1.
// Worked number: k = 2e-4 of joint 4 at 40 deg (0.6981 rad) turns joint 5 by 139.6 urad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/joint_effect.h"

namespace dhcal {
namespace {

class JointCouplingEffect final : public JointEffect {
 public:
  JointCouplingEffect() : JointEffect(About(), {EffectClass::kCoupling, DriverKind::kJointAngle}) {}

  std::string NotTestableAt(const PhysicsContext& c, const EffectRequest& request) const override {
    const int driver = DrivingJoint(request);
    if (driver < 0 || driver >= c.num_joints() || driver == JointIndex(request)) {
      return fmt::format("needs another joint from 1 to {} as driver_joint", c.num_joints());
    }
    return c.moves(driver) ? "" : "the driving joint does not move";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    return {SlotColumn("coupling",
                       "rad/rad",
                       2e-4,
                       c.joint_slot(JointIndex(request)),
                       c.q(DrivingJoint(request)))};
  }
  /// Couplings of the last three joints, and of the third by the second (a parallelogram).
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    std::vector<EffectRequest> requests;
    const int n = c.num_joints();
    const auto add = [&](int driver, int joint) {
      if (driver < 1 || joint > n) return;
      EffectRequest request = Request(joint);
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
    const bool wrist = request.joint > c.num_joints() - 3;
    return {wrist ? EffectClass::kWristMotion : EffectClass::kCoupling,
            JointName(request.joint),
            {DriverKind::kJointAngle, DrivingJoint(request) + 1}};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }
  std::string Sentence(const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("joint {} is turned by joint {}: {}",
                       request.joint,
                       DrivingJoint(request) + 1,
                       Quantity(Find(values, "coupling"), 1e-3, "mrad per rad"));
  }
  WorkedExample Example() const override {
    return {WithValue(WithSetting(Request(5), "driver_joint", 4), "coupling", 2e-4),
            1,
            "theta5",
            2e-4 * 0.698131700797732};
  }

 private:
  static EffectDescription About() {
    EffectDescription d{"joint_coupling",
                        "a joint is turned by the motion of another one",
                        "d theta_j = k q_i",
                        "coupling [rad/rad]",
                        {JointNumber("driver_joint", "i; default: the joint before j")},
                        "a second joint that moves",
                        "0.1-1 mrad/rad [physics.md W1]"};
    d.per_joint = PerJoint::kOfEachKind;
    return d;
  }

  static int DrivingJoint(const EffectRequest& request) {
    return static_cast<int>(request.setting("driver_joint", request.joint - 1)) - 1;
  }
};

}  // namespace

const Effect& JointCoupling() {
  static const JointCouplingEffect effect;
  return effect;
}

}  // namespace dhcal
