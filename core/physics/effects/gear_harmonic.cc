// Periodic transmission error of a joint: eccentric gear, encoder or mesh.
//
//   d theta_j = A sin(N q_j) + B cos(N q_j)  A, B [rad], N = order (setting)
//
// N = 1, 2: output-stage runout, eccentric joint encoder, bearing. N = 3 to 7: bolts, planets, a
// slow intermediate shaft. High N: gear mesh, wave generator (2 x ratio), motor-side resolver;
// found by scanning (need not be an integer).
// Typical: 0.1 mrad at N = 1 (RV gears 50-70 arcsec peak to peak), 0.02-0.15 mrad at mesh orders.
// Source: physics.md G1, G2, G3.
// Worked number: A = 0.1 mrad, N = 1, q = 30 deg adds 50 urad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/joint_effect.h"

namespace dhcal {
namespace {

std::string WithOrder(const char* name, double order) {
  return fmt::format("{}_{:g}", name, order);
}

class GearHarmonicEffect final : public JointEffect {
 public:
  GearHarmonicEffect()
      : JointEffect(About(),
                    {EffectClass::kGearLine, DriverKind::kJointAngle, JointNeeds::kTurningMotion}) {
  }

  std::string NotTestableAt(const PhysicsContext& /*c*/,
                            const EffectRequest& request) const override {
    return Order(request) > 0 ? "" : "the order must be positive";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    const double order = Order(request);
    const Eigen::ArrayXd phase = order * c.q(joint).array();
    const double typical = order < 3 ? 1e-4 : 5e-5;
    return {
        SlotColumn(
            WithOrder("sin", order), "rad", typical, c.joint_slot(joint), phase.sin().matrix()),
        SlotColumn(
            WithOrder("cos", order), "rad", typical, c.joint_slot(joint), phase.cos().matrix())};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    std::vector<EffectRequest> requests;
    for (const double order : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}) {
      for (EffectRequest request : EveryJoint(c)) {
        request.settings["order"] = order;
        requests.push_back(request);
      }
    }
    return requests;
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& request) const override {
    const double order = Order(request);
    return {order < 3 ? SmoothInAngleOf(request.joint) : EffectClass::kGearLine,
            JointName(request.joint),
            {DriverKind::kJointAngle, request.joint}};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }
  double Order(const EffectRequest& request) const override { return request.setting("order", 1); }
  std::string Sentence(const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const double order = Order(request);
    const EffectValue amplitude =
        Amplitude(Find(values, WithOrder("sin", order)), Find(values, WithOrder("cos", order)));
    return fmt::format("joint {} errs periodically, {:.4g} times per turn, with an amplitude of {}",
                       request.joint,
                       order,
                       Quantity(amplitude, 1e-3, "mrad"));
  }
  WorkedExample Example() const override {
    return {WithValue(WithSetting(Request(3), "order", 1), "sin_1", 1e-4), 1, "theta3", 5e-5};
  }

 private:
  static EffectDescription About() {
    EffectDescription d{"gear_harmonic",
                        "a gear or encoder errs periodically with the joint's angle",
                        "d theta_j = A sin(N q_j) + B cos(N q_j)",
                        "sin_<N>, cos_<N> [rad]",
                        {Scanned(Number("order", "N, default 1"), SettingScan::kOrders)},
                        "",
                        "0.1 mrad at N = 1; 0.02-0.15 mrad at mesh orders [physics.md G1-G3]"};
    d.per_joint = PerJoint::kManyLines;
    return d;
  }
};

}  // namespace

const Effect& GearHarmonic() {
  static const GearHarmonicEffect effect;
  return effect;
}

}  // namespace dhcal
