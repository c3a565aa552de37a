// Time offset between joint read-out and measurement.
//
//   d theta_j = -t qdot_j, all joints        t [s]; > 0: the joints were read too early
//
// The robot goes on moving after the joints were read, or has not got there: with t > 0 the point
// is measured where the joints were t before the stamp.
// Typical: 1 ms at 0.3 m/s: 0.3 mm. Source: PHYSICS.md Y1.
// Worked number: t = 1 ms at 0.5 rad/s: -0.5 mrad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"

namespace dhcal {
namespace {

class LatencyEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{"latency",
                        "joints and position were not read at the same instant",
                        "d theta_j = -t qdot_j, all joints",
                        "time [s]",
                        {},
                        "qd<j>_deg_s (or _rad_s)",
                        "0.1-5 ms [PHYSICS.md Y1]"};
    d.has_joint = false;
    return d;
  }
  std::string NotTestable(const PhysicsContext& c,
                          const EffectRequest& /*request*/) const override {
    const Eigen::MatrixXd& speed = c.recording().speed;
    if (speed.rows() == 0 || !speed.allFinite()) return "the recording has no joint speeds";
    return speed.cwiseAbs().maxCoeff() > 1e-6 ? "" : "the robot stood still at every row";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& /*request*/) const override {
    EffectColumn column;
    column.parameter = "time";
    column.unit = "s";
    column.typical = 1e-3;
    for (int joint = 0; joint < c.num_joints(); ++joint) {
      column.slots.push_back(
          {c.joint_slot(joint), -c.sign(joint) * c.recording().speed.col(joint)});
    }
    return {column};
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"timing", "sensor", "joint speed"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& /*request*/,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the position is that of {} before the joints' stamp",
                       Quantity(Find(values, "time"), 1e-3, "ms"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "latency";
    example.request.values["time"] = 1e-3;
    example.row = 1;
    example.slot = "theta2";
    example.expected = -5e-4;
    return example;
  }
};

}  // namespace

const Effect& Latency() {
  static const LatencyEffect effect;
  return effect;
}

}  // namespace dhcal
