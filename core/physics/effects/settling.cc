// Readings taken before the arm had settled: every joint still lacks a part of its last move.
//
//   d theta_j = -s (q_j - q_j of the row before)          s [1], the same for all joints
//
// Not a play: it grows with the move. Only where the rows are in the order of the motion; the first
// row of a run has no move that is known.
// Typical: 1e-4 of the move. Source: PHYSICS.md Y2.
// Worked number: s = 0.001 after 20 deg of joint 2: -0.349 mrad.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"

namespace dhcal {
namespace {

constexpr double kLeastMove = 0.01;  // [rad or m] that a joint must move to lack a part of it

/// Last move of each joint in DH's sense, rows x n [rad or m].
Eigen::MatrixXd LastMoves(const PhysicsContext& c) {
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(c.num_rows(), c.num_joints());
  for (int j = 0; j < c.num_joints(); ++j) {
    const Eigen::VectorXd q = c.q(j);
    for (int row = 1; row < c.num_rows(); ++row) {
      if (c.recording().run(row) == c.recording().run(row - 1)) moves(row, j) = q[row] - q[row - 1];
    }
  }
  return moves;
}

class SettlingEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{"settling",
                        "read before the arm had settled: joints lack a part of their last move",
                        "d theta_j = -s (q_j - q_j of the row before)",
                        "share [1]",
                        {},
                        "rows in the order of the motion",
                        "1e-4 of the move [PHYSICS.md Y2]"};
    d.has_joint = false;
    return d;
  }
  std::string NotTestable(const PhysicsContext& c,
                          const EffectRequest& /*request*/) const override {
    return LastMoves(c).cwiseAbs().maxCoeff() > kLeastMove ? "" : "no joint moves between rows";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& /*request*/) const override {
    const Eigen::MatrixXd moves = LastMoves(c);
    EffectColumn column;
    column.parameter = "share";
    column.unit = "1";
    column.typical = 1e-4;
    column.positive = true;
    for (int j = 0; j < c.num_joints(); ++j) {
      column.slots.push_back({c.joint_slot(j), -moves.col(j)});
    }
    return {column};
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"C4", "all joints", "last move"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& /*request*/,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format(
        "the arm was read before it had settled: every joint still lacks {} of its last move",
        Quantity(Find(values, "share"), 1e-2, "%"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "settling";
    example.request.values["share"] = 1e-3;
    example.row = 1;
    example.slot = "theta2";
    example.expected = -3.490658503988659e-4;
    return example;
  }
};

}  // namespace

const Effect& Settling() {
  static const SettlingEffect effect;
  return effect;
}

}  // namespace dhcal
