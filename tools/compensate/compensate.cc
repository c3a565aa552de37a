#include "tools/compensate/compensate.h"

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/math/rotation.h"

namespace dhcal {
namespace {

// Effects change by a thousandth or so of what they are per correction: three rounds settle them.
constexpr int kMostRounds = 20;

/// What is left of a row at its command.
void Measure(const Eigen::Isometry3d& wanted, const Eigen::Isometry3d& reached, Command* command) {
  command->position_error = (wanted.translation() - reached.translation()).norm();
  command->rotation_error =
      LogSO3(Eigen::Matrix3d(wanted.linear() * reached.linear().transpose())).norm();
}

}  // namespace

std::vector<Command> Compensate(const RealArm& arm,
                                const std::vector<Eigen::Isometry3d>& X_WQ,
                                const Seeds& seeds) {
  const std::size_t num_rows = X_WQ.size();
  std::vector<Command> commands(num_rows);
  Eigen::MatrixXd q = seeds.q;
  Eigen::MatrixXd deltas = arm.Deltas(q);
  // What a chain of few joints leaves of the orientation is no want of agreement.
  std::vector<double> left(num_rows, 0.0);
  bool settled = false;
  for (int round = 0; round < kMostRounds && !settled; ++round) {
    settled = true;
    for (std::size_t row = 0; row < num_rows; ++row) {
      Command& command = commands[row];
      const auto at = static_cast<Eigen::Index>(row);
      if (round == 0 && row > 0 && seeds.first_only) q.row(at) = q.row(at - 1);
      const InverseSolution solution = arm.inverse().Solve(
          X_WQ[row], arm.StateOf(deltas, static_cast<int>(row)), q.row(at).transpose());
      command.refusal = solution.reason;
      left[row] = solution.rotation_error;
      // A refused row stays where it was, so that rows after it do not jump.
      if (solution.found) q.row(at) = solution.q.transpose();
    }
    deltas = arm.Deltas(q);
    for (std::size_t row = 0; row < num_rows; ++row) {
      Measure(X_WQ[row], arm.Pose(q, deltas, static_cast<int>(row)), &commands[row]);
      settled = settled && (!commands[row].refusal.empty() ||
                            (commands[row].position_error <= kSettledPosition &&
                             commands[row].rotation_error <= left[row] + kSettledRotation));
    }
  }
  for (std::size_t row = 0; row < num_rows; ++row) {
    Command& command = commands[row];
    command.q = q.row(static_cast<Eigen::Index>(row)).transpose();
    const bool there = command.position_error <= kSettledPosition &&
                       command.rotation_error <= left[row] + kSettledRotation;
    if (command.refusal.empty() && !there) {
      command.refusal = fmt::format(
          "command and effects do not settle: {:.3g} um remain (an approach direction that "
          "changes with the correction?)",
          command.position_error / kMicrometre);
    }
  }
  return commands;
}

}  // namespace dhcal
