// Wobble of a joint's axis: its bearing tilts it N times per turn.
//
//   tilt about x, y of the axis' fixed frame:  w_x cos Nq - w_y sin Nq,  w_x sin Nq + w_y cos Nq
//
// w [rad]. N = 1 is mostly geometry (an alpha error turning with the rotor); N = 2 is genuine.
// Typical: 10-50 urad. Source: physics.md X2.
// Worked number: w_x = 50 urad at joint 1, q = 10 deg, N = 2: base_rx = 50 cos 20 deg = 46.98 urad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/joint_effect.h"

namespace dhcal {
namespace {

class AxisWobbleEffect final : public JointEffect {
 public:
  AxisWobbleEffect()
      : JointEffect({"axis_wobble",
                     "a joint's axis tilts periodically with its angle",
                     "tilt = R(N q_j) (w_x, w_y)",
                     "x, y [rad]",
                     {Number("order", "N, default 2")},
                     "",
                     "10-50 urad [physics.md X2]"},
                    {EffectClass::kWobble, DriverKind::kJointAngle, JointNeeds::kTurningMotion}) {}

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    return {Column(c, request, "x", 0), Column(c, request, "y", 1)};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    std::vector<EffectRequest> requests = EveryJoint(c);
    for (EffectRequest& request : requests) request.settings["order"] = 2;
    return requests;
  }
  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    const bool wrist = request.joint > c.num_joints() - 3;
    return {wrist ? EffectClass::kWristMotion : EffectClass::kWobble,
            JointName(request.joint),
            {DriverKind::kJointAngle, request.joint}};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }
  double Order(const EffectRequest& request) const override { return request.setting("order", 2); }
  std::string Sentence(const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the axis of joint {} wobbles {:g} times per turn by {}",
                       request.joint,
                       Order(request),
                       Quantity(Amplitude(Find(values, "x"), Find(values, "y")), 1e-6, "urad"));
  }
  WorkedExample Example() const override {
    return {WithValue(WithSetting(Request(1), "order", 2), "x", 50e-6),
            1,
            "base_rx",
            50e-6 * 0.939692620785908};
  }

 private:
  EffectColumn Column(const PhysicsContext& c,
                      const EffectRequest& request,
                      const char* name,
                      int component) const {
    const int joint = JointIndex(request);
    const Eigen::VectorXd phase = Order(request) * c.q(joint);
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
