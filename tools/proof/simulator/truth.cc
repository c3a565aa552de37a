#include "tools/proof/simulator/truth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/units.h"
#include "tools/proof/simulator/screw.h"
#include "tools/proof/simulator/statics.h"

namespace dhcal::concealed {
namespace {

using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The play operator: the output follows the motor once the gap is closed.
double FollowThroughGap(double motor, double gap, double output) {
  return std::clamp(output, motor - gap / 2, motor + gap / 2);
}

/// Friction winds the gear up as the joint travels after a reversal (Dahl's law): the output stays
/// behind by `size` in the end.
double WindUp(const Drive& drive, double size, double travel, double state) {
  const double target = travel > 0 ? -size : size;
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

/// How base and tool are moved at a pose.
struct Frames {
  Vector3d base_shift = Vector3d::Zero();  // [m] in the base's own frame
  Vector3d tool_shift = Vector3d::Zero();  // [m] in the flange's
  std::vector<Move> base_moves;
};

Isometry3d Moved(const Isometry3d& frame, const Move& move) {
  Isometry3d moved = frame;
  moved.translation() += move.shift;
  moved.linear() = Displacement(move.turn, Vector3d::Zero()).linear() * frame.linear();
  return moved;
}

double Warmed(double time, double lag) { return 1 - std::exp(-time / lag); }

/// What the joints' angles, speeds and last moves do to them, and how the axes tilt.
void HoldJoints(const Physics& physics, const Motion& motion, int row, Circumstances* at) {
  const VectorXd q = motion.q.row(row).transpose();
  const auto i = static_cast<std::size_t>(row);
  if (motion.speed.rows() > 0) at->held -= physics.latency * motion.speed.row(row).transpose();
  if (row > 0 && motion.run[i] == motion.run[i - 1]) {
    at->held -= physics.settling * (q - motion.q.row(row - 1).transpose());
  }
  for (int j = 0; j < q.size(); ++j) at->held[j] += ErrorOf(physics, j, q);
  if (physics.wobbles.empty()) return;
  at->tilts.assign(static_cast<std::size_t>(q.size()), Eigen::Vector2d::Zero());
  for (const Wobble& wobble : physics.wobbles) {
    const double angle = wobble.order * q[wobble.joint] + wobble.phase;
    at->tilts[static_cast<std::size_t>(wobble.joint)] +=
        wobble.amplitude * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
}

/// Heat, drifts, steps and what changes between runs.
void MoveWithTime(
    const Physics& physics, const Motion& motion, int row, Circumstances* at, Frames* frames) {
  const double time = motion.time[row];
  for (const Step& step : physics.steps) {
    if (row < step.at_row) continue;
    if (step.joint >= 0) at->held[step.joint] += step.angle;
    frames->tool_shift += step.shift;
    if (step.joint == -2) frames->base_moves.push_back(step.base);
  }
  for (const Drift& drift : physics.drifts) {
    if (drift.joint >= 0) at->held[drift.joint] += drift.angle * Warmed(time, drift.lag);
    frames->base_shift += drift.motion * Warmed(time, drift.lag);
  }
  at->growth.assign(static_cast<std::size_t>(motion.q.cols()), 0.0);
  const std::vector<double> warmth = Warmth(physics.thermal, time);
  for (std::size_t i = 0; i < warmth.size(); ++i) {
    at->growth[static_cast<std::size_t>(physics.thermal[i].link) - 1] +=
        warmth[i] * physics.thermal[i].strain;
  }
  frames->base_shift += physics.sway * std::sin(2 * kPi * time / physics.sway_period);
  if (physics.base_of_run.empty()) return;
  const int run = motion.run[static_cast<std::size_t>(row)];
  frames->base_moves.push_back(physics.base_of_run[static_cast<std::size_t>(run) - 1]);
}

/// The arm as it is at a row.
Arm ArmAt(const Arm& built, const Physics& physics, int row) {
  Arm arm = built;
  for (const Follower& follower : physics.followers) {
    follower.move(&arm, follower.amount[row]);
  }
  return arm;
}

}  // namespace

double ScaleOf(const Instrument& instrument, double time) {
  return 1 + instrument.growth * Warmed(time, instrument.lag);
}

MatrixXd LostMotion(const Arm& built, const Physics& physics, const Motion& motion) {
  const ScrewArm screws(built);
  const int n = built.num_joints();
  MatrixXd lost = MatrixXd::Zero(motion.num_poses(), n);
  const bool any = std::any_of(physics.drives.begin(), physics.drives.end(), [](const Drive& d) {
    return d.play != 0 || d.windup != 0;
  });
  if (!any) return lost;
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
      const double size = drive.windup * (drive.windup_form ? drive.windup_form(q[j]) : 1);
      if (!fresh) windup[j] = WindUp(drive, size, q[j] - motion.q(row - 1, j), windup[j]);
      lost(row, j) = output[j] - q[j] + windup[j];
    }
  }
  return lost;
}

std::vector<Isometry3d> TruePoses(const Arm& built, const Physics& physics, const Motion& motion) {
  const MatrixXd lost = LostMotion(built, physics, motion);
  std::vector<Isometry3d> poses;
  for (int row = 0; row < motion.num_poses(); ++row) {
    const Arm arm = ArmAt(built, physics, row);
    const ScrewArm screws(arm);
    Frames frames;
    Circumstances at;
    at.payload = motion.payload[row];
    at.held = lost.row(row).transpose();
    HoldJoints(physics, motion, row, &at);
    MoveWithTime(physics, motion, row, &at, &frames);
    const Eigen::Isometry3d flange =
        Equilibrium(arm, screws, physics, motion.q.row(row).transpose(), at);
    const auto i = static_cast<std::size_t>(row);
    const Isometry3d& tool = arm.target(motion.target.empty() ? 0 : motion.target[i]);
    Isometry3d base = arm.base;
    for (const Move& move : frames.base_moves) base = Moved(base, move);
    poses.emplace_back(base * Eigen::Translation3d(frames.base_shift) * flange *
                       Eigen::Translation3d(frames.tool_shift) * tool);
  }
  return poses;
}

MatrixXd TruePositions(const Arm& built, const Physics& physics, const Motion& motion) {
  const std::vector<Isometry3d> poses = TruePoses(built, physics, motion);
  MatrixXd positions(motion.num_poses(), 3);
  for (Eigen::Index row = 0; row < positions.rows(); ++row) {
    positions.row(row) = poses[static_cast<std::size_t>(row)].translation().transpose();
  }
  return positions;
}

}  // namespace dhcal::concealed
