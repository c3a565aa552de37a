// Wobble of a joint's axis: its bearing tilts it N times per turn.
//
//   tilt about x, y of the axis' fixed frame:  w_x cos Nq - w_y sin Nq,  w_x sin Nq + w_y cos Nq
//
// w [rad]. N = 1 is mostly geometry (an alpha error turning with the rotor); N = 2 is genuine.
// Typical: 10-50 urad. Source: PHYSICS.md X2.
// Worked number: w_x = 50 urad at joint 1, q = 10 deg, N = 2: base_rx = 50 cos 20 deg = 46.98 urad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"

namespace dhcal {
namespace {

class AxisWobbleEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"axis_wobble",
            "a joint's axis tilts periodically with its angle",
            "tilt = R(N q_j) (w_x, w_y)",
            "x, y [rad]",
            {{"order", "N, default 2"}},
            "",
            "10-50 urad [PHYSICS.md X2]"};
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    if (!c.revolute(JointIndex(request))) return "the joint is prismatic";
    return c.moves(JointIndex(request)) ? "" : "the joint does not move";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    return {Column(c, request, "x", 0), Column(c, request, "y", 1)};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    std::vector<EffectRequest> requests = EveryJoint(c, "axis_wobble");
    for (EffectRequest& request : requests) request.settings["order"] = 2;
    return requests;
  }
  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    return {request.joint > c.num_joints() - 3 ? "C9" : "wobble",
            JointName(request.joint),
            "joint angle"};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }
  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the axis of {} wobbles, {:g} {} per revolution, by {}",
                       JointWords(context, request.joint),
                       request.setting("order", 2),
                       request.setting("order", 2) == 1 ? "cycle" : "cycles",
                       Quantity(Amplitude(Find(values, "x"), Find(values, "y")), 1e-6, "urad"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "axis_wobble";
    example.request.joint = 1;
    example.request.settings["order"] = 2;
    example.request.values["x"] = 50e-6;
    example.row = 1;
    example.slot = "base_rx";
    example.expected = 50e-6 * 0.939692620785908;
    return example;
  }

 private:
  static EffectColumn Column(const PhysicsContext& c,
                             const EffectRequest& request,
                             const char* name,
                             int component) {
    const int joint = JointIndex(request);
    const Eigen::VectorXd phase = request.setting("order", 2) * c.q(joint);
    return TwistColumn(c, name, "rad", 4e-5, [&](int row) {
      // The fixed frame of the axis: x and y as they stand when the joint is at zero.
      const Eigen::Vector3d axis = c.axis(row, joint);
      const Eigen::Matrix3d R_moving = c.X_BL(row, joint - 1).linear();
      Eigen::Vector3d x = R_moving.col(0) - axis * axis.dot(R_moving.col(0));
      if (x.norm() < 0.5) x = R_moving.col(1) - axis * axis.dot(R_moving.col(1));
      x.normalize();
      const Eigen::Vector3d y = axis.cross(x);
      const double u = component == 0 ? std::cos(phase[row]) : -std::sin(phase[row]);
      const double v = component == 0 ? std::sin(phase[row]) : std::cos(phase[row]);
      Twist twist;
      twist.at = c.axis_point(row, joint);
      twist.rotation = u * x + v * y;
      return twist;
    });
  }
};

}  // namespace

const Effect& AxisWobble() {
  static const AxisWobbleEffect effect;
  return effect;
}

}  // namespace dhcal
