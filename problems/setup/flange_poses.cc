#include "problems/setup/flange_poses.h"

#include <cmath>
#include <utility>

#include "core/base/units.h"

namespace dhcal {
namespace {

using Numbers = FlangePoses::Numbers;
using Axis = std::array<Numbers, 3>;

/// Turns the axes u and v about their common normal: u' = c u + s v, v' = c v - s u.
template <typename Cosine, typename Sine>
void TurnAxes(const Cosine& c, const Sine& s, Axis* u, Axis* v) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Numbers turned = c * (*u)[k] + s * (*v)[k];
    (*v)[k] = c * (*v)[k] - s * (*u)[k];
    (*u)[k] = turned;
  }
}

template <typename Amount>
void Shift(const Amount& amount, const Axis& axis, Axis* p) {
  for (std::size_t k = 0; k < 3; ++k) (*p)[k] += amount * axis[k];
}

}  // namespace

double FactorOf(AngleUnit unit) {
  switch (unit) {
    case AngleUnit::kAsWritten:
      return 1;
    case AngleUnit::kHoldsRadians:
      return 1 / kDegree;
    case AngleUnit::kHoldsDegrees:
      return kDegree;
  }
  return 1;
}

FlangeOfRows::FlangeOfRows(const RobotModel& robot,
                           const Recording& recording,
                           const std::vector<int>& rows)
    : robot_(robot), num_rows_(static_cast<int>(rows.size())) {
  for (int column = 0; column < recording.num_joints(); ++column) {
    Numbers q(num_rows_);
    for (int k = 0; k < num_rows_; ++k)
      q[k] = recording.q(rows[static_cast<std::size_t>(k)], column);
    coordinates_.push_back(q);
    auto& turns = turns_.emplace_back();
    for (const AngleUnit unit :
         {AngleUnit::kAsWritten, AngleUnit::kHoldsRadians, AngleUnit::kHoldsDegrees}) {
      const Numbers angle = FactorOf(unit) * q;
      turns[static_cast<std::size_t>(unit)] = {angle.cos(), angle.sin()};
    }
  }
}

FlangeOfRows::Turn FlangeOfRows::AngleOf(const SetUp& set_up, int joint_idx) const {
  const auto idx = static_cast<std::size_t>(joint_idx);
  const JointRow& row = robot_.joints[idx];
  const SetUp::Joint& joint = set_up.joints[idx];
  const double theta =
      FactorOf(set_up.table_unit) * row.theta + joint.quarters * kPi / 2 + joint.offset;
  const double c = std::cos(theta), s = std::sin(theta);
  if (row.type == JointType::kPrismatic) {
    return {Numbers::Constant(num_rows_, c), Numbers::Constant(num_rows_, s)};
  }
  const auto add = [](const Turn& turn, const Numbers& cos, const Numbers& sin) {
    return Turn{turn.cos * cos - turn.sin * sin, turn.sin * cos + turn.cos * sin};
  };
  const Turn& own = TurnOf(joint);
  const double sign = row.sign * joint.sense;
  Turn turn{own.cos * c - sign * own.sin * s, sign * own.sin * c + own.cos * s};
  if (joint.driver >= 0) {
    const Turn& driver = TurnOf(set_up.joints[static_cast<std::size_t>(joint.driver)]);
    turn = add(turn, driver.cos, joint.driver_factor * driver.sin);
  }
  return turn;
}

void FlangeOfRows::Evaluate(const SetUp& set_up, FlangePoses* poses) const {
  for (std::size_t k = 0; k < 3; ++k) {
    poses->p[k] = Numbers::Zero(num_rows_);
    for (std::size_t c = 0; c < 3; ++c) {
      poses->R[c][k] = Numbers::Constant(num_rows_, c == k ? 1.0 : 0.0);
    }
  }
  Axis &x = poses->R[0], &y = poses->R[1], &z = poses->R[2];
  Axis& p = poses->p;
  const bool standard = (robot_.convention == DhConvention::kStandard) != set_up.other_convention;
  const double scale = set_up.table_scale;
  for (int j = 0; j < robot_.num_joints(); ++j) {
    const auto idx = static_cast<std::size_t>(j);
    const JointRow& row = robot_.joints[idx];
    const double alpha = FactorOf(set_up.table_unit) * row.alpha;
    const auto twist = [&] {
      TurnAxes(std::cos(alpha), std::sin(alpha), &y, &z);
      // Ry(beta): z turns into x.
      if (row.beta != 0) TurnAxes(std::cos(row.beta), std::sin(row.beta), &z, &x);
    };
    if (!standard) {
      Shift(scale * row.a, x, &p);
      twist();
    }
    const Turn turn = AngleOf(set_up, j);
    TurnAxes(turn.cos, turn.sin, &x, &y);
    if (row.type == JointType::kPrismatic) {
      const SetUp::Joint& joint = set_up.joints[idx];
      const Numbers d =
          row.d + row.sign * joint.sense * coordinates_[static_cast<std::size_t>(joint.column)];
      Shift(d, z, &p);
    } else {
      Shift(scale * row.d, z, &p);
    }
    if (standard) {
      Shift(scale * row.a, x, &p);
      twist();
    }
  }
}

}  // namespace dhcal
