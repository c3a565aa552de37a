// Periodic transmission error of a joint: eccentric gear, encoder or mesh.
//
//   d theta_j = A sin(N q_j) + B cos(N q_j)  A, B [rad], N = order (setting)
//
// N = 1, 2: output-stage runout, eccentric joint encoder, bearing. N = 3 to 7: bolts, planets, a
// slow intermediate shaft. High N: gear mesh, wave generator (2 x ratio), motor-side resolver;
// found by scanning (need not be an integer).
// Typical: 0.1 mrad at N = 1 (RV gears 50-70 arcsec peak to peak), 0.02-0.15 mrad at mesh orders.
// Source: PHYSICS.md G1, G2, G3.
// Worked number: A = 0.1 mrad, N = 1, q = 30 deg adds 50 urad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"

namespace dhcal {
namespace {

std::string WithOrder(const char* name, double order) {
  return fmt::format("{}_{:g}", name, order);
}

class GearHarmonicEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"gear_harmonic",
            "a gear or encoder errs periodically with the joint's angle",
            "d theta_j = A sin(N q_j) + B cos(N q_j)",
            "sin_<N>, cos_<N> [rad]",
            {{"order", "N, default 1"}},
            "",
            "0.1 mrad at N = 1; 0.02-0.15 mrad at mesh orders [PHYSICS.md G1-G3]"};
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    if (!c.revolute(JointIndex(request))) return "the joint is prismatic";
    if (!(request.setting("order", 1) > 0)) return "the order must be positive";
    return c.moves(JointIndex(request)) ? "" : "the joint does not move";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    const double order = request.setting("order", 1);
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
      for (EffectRequest request : EveryJoint(c, "gear_harmonic")) {
        request.settings["order"] = order;
        requests.push_back(request);
      }
    }
    return requests;
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& request) const override {
    const double order = request.setting("order", 1);
    const char* const smooth = request.joint == 2 ? "C2" : "C3";
    return {order < 3 ? smooth : "C8", JointName(request.joint), "joint angle"};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }
  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const double order = request.setting("order", 1);
    const EffectValue amplitude =
        Amplitude(Find(values, WithOrder("sin", order)), Find(values, WithOrder("cos", order)));
    return fmt::format("{} has a periodic error, {:.4g} {} per revolution, amplitude {}",
                       JointWords(context, request.joint),
                       order,
                       order == 1 ? "cycle" : "cycles",
                       Quantity(amplitude, 1e-3, "mrad"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "gear_harmonic";
    example.request.joint = 3;
    example.request.settings["order"] = 1;
    example.request.values["sin_1"] = 1e-4;
    example.row = 1;
    example.slot = "theta3";
    example.expected = 5e-5;
    return example;
  }
};

}  // namespace

const Effect& GearHarmonic() {
  static const GearHarmonicEffect effect;
  return effect;
}

}  // namespace dhcal
