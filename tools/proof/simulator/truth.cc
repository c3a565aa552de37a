#include "tools/proof/simulator/truth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/units.h"
#include "tools/proof/simulator/statics.h"

namespace dhcal::concealed {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The play operator: the output follows the motor once the gap is closed.
double FollowThroughGap(double motor, double gap, double output) {
  return std::clamp(output, motor - gap / 2, motor + gap / 2);
}

/// Friction winds the gear up as the joint travels after a reversal (Dahl's law): the output stays
/// behind by `windup` in the end.
double WindUp(const Drive& drive, double travel, double state) {
  const double target = travel > 0 ? -drive.windup : drive.windup;
  return target + (state - target) * std::exp(-std::abs(travel) / drive.windup_travel);
}

/// [rad] of a joint that no load makes and that has no memory.
double ErrorOf(const Physics& physics, int joint, const VectorXd& q) {
  const Drive& drive = physics.drives[static_cast<std::size_t>(joint)];
  double error = drive.gain * q[joint];
  if (drive.form) error += drive.form(q[joint]);
  for (const GearLine& line : physics.lines) {
    if (line.joint == joint) error += line.amplitude * std::sin(line.order * q[joint] + line.phase);
  }
  for (const Coupling& coupling : physics.couplings) {
    if (coupling.joint == joint) error += coupling.ratio * q[coupling.driver];
  }
  if (physics.cross) error += physics.cross(joint, q);
  return error;
}

/// State of the chain of thermal bodies at a time, each 0 to 1: dT_i/dt = (T_(i-1) - T_i) / lag_i.
/// Integrated exactly over steps much shorter than the lags.
std::vector<double> Warmth(const std::vector<ThermalBody>& bodies, double time) {
  std::vector<double> state(bodies.size(), 0.0);
  if (bodies.empty()) return state;
  const int steps = std::max(1, static_cast<int>(time / 10));
  const double dt = time / steps;
  for (int step = 0; step < steps; ++step) {
    double drive = 1;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const double before = state[i];
      state[i] += (drive - state[i]) * (1 - std::exp(-dt / bodies[i].lag));
      drive = before;
    }
  }
  return state;
}

}  // namespace

MatrixXd LostMotion(const Arm& built, const Physics& physics, const Motion& motion) {
  const ScrewArm screws(built);
  const int n = built.num_joints();
  MatrixXd lost = MatrixXd::Zero(motion.num_poses(), n);
  VectorXd output, windup = VectorXd::Zero(n);
  for (int row = 0; row < motion.num_poses(); ++row) {
    const VectorXd q = motion.q.row(row).transpose();
    const auto i = static_cast<std::size_t>(row);
    const bool fresh = row == 0 || motion.run[i] != motion.run[i - 1];
    if (fresh) {
      output = q;
      windup.setZero();
    }
    const VectorXd torque = RigidTorques(built, screws, q, motion.payload[row]);
    for (int j = 0; j < n; ++j) {
      const Drive& drive = physics.drives[static_cast<std::size_t>(j)];
      if (std::abs(torque[j]) > drive.preload) {
        output[j] = q[j] + (torque[j] > 0 ? 0.5 : -0.5) * drive.play;
      } else {
        output[j] = FollowThroughGap(q[j], drive.play, output[j]);
      }
      if (!fresh) windup[j] = WindUp(drive, q[j] - motion.q(row - 1, j), windup[j]);
      lost(row, j) = output[j] - q[j] + windup[j];
    }
  }
  return lost;
}

MatrixXd TruePositions(const Arm& built, const Physics& physics, const Motion& motion) {
  const ScrewArm screws(built);
  const int n = built.num_joints();
  const MatrixXd lost = LostMotion(built, physics, motion);
  MatrixXd positions(motion.num_poses(), 3);
  for (int row = 0; row < motion.num_poses(); ++row) {
    const VectorXd q = motion.q.row(row).transpose();
    Circumstances at;
    at.payload = motion.payload[row];
    at.growth.assign(static_cast<std::size_t>(n), 0.0);
    at.held = lost.row(row).transpose();
    if (motion.speed.rows() > 0) at.held -= physics.latency * motion.speed.row(row).transpose();
    for (int j = 0; j < n; ++j) at.held[j] += ErrorOf(physics, j, q);
    Vector3d tool_shift = Vector3d::Zero(), base_shift = Vector3d::Zero();
    for (const Step& step : physics.steps) {
      if (row < step.at_row) continue;
      if (step.joint >= 0) at.held[step.joint] += step.angle;
      tool_shift += step.shift;
    }
    const double time = motion.time[row];
    const std::vector<double> warmth = Warmth(physics.thermal, time);
    for (std::size_t i = 0; i < warmth.size(); ++i) {
      const ThermalBody& body = physics.thermal[i];
      base_shift += warmth[i] * body.motion;
      if (body.link > 0)
        at.growth[static_cast<std::size_t>(body.link) - 1] += warmth[i] * body.strain;
    }
    base_shift += physics.sway * std::sin(2 * kPi * time / physics.sway_period);
    const Eigen::Isometry3d flange = Equilibrium(built, screws, physics, q, at);
    positions.row(row) =
        (built.base * (base_shift + flange * (tool_shift + built.tool.translation()))).transpose();
  }
  return positions;
}

}  // namespace dhcal::concealed
