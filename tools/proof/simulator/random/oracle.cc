#include "tools/proof/simulator/random/oracle.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "tools/proof/simulator/random/movers.h"
#include "tools/proof/simulator/random/observe.h"
#include "tools/proof/simulator/random/poses.h"
#include "tools/proof/simulator/truth.h"
#include "tools/proof/simulator/visibility.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;
using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Differences of readings that neighbours share say of the positions all but a constant of each
/// run.
MatrixXd RunConstants(const RandomTrial& trial) {
  const bool free = trial.settings.kind == Kind::kAdjacent && trial.settings.shared_pose;
  const int runs = free ? trial.settings.runs : 0;
  MatrixXd constants = MatrixXd::Zero(3 * trial.motion.num_poses(), 3 * runs);
  for (Index row = 0; runs > 0 && row < trial.motion.num_poses(); ++row) {
    const int run = trial.motion.run[static_cast<std::size_t>(row)] - 1;
    constants.block<3, 3>(3 * row, 3 * run).setIdentity();
  }
  return constants;
}

/// What each cause adds to the readings, given the others.
MatrixXd CauseSignals(const RandomTrial& trial) {
  const World all{trial.built, AllPhysics(trial)};
  const std::vector<Isometry3d> reference = TruePoses(all.arm, all.physics, trial.motion);
  const VectorXd seen = Seen(trial, all, reference);
  MatrixXd signals(seen.size(), static_cast<Index>(trial.causes.size()));
  for (std::size_t k = 0; k < trial.causes.size(); ++k) {
    const World without{trial.built, PhysicsWithout(trial, k)};
    signals.col(static_cast<Index>(k)) = seen - Seen(trial, without, reference);
  }
  return signals;
}

/// Rows that are fitted, each coordinate over its noise.
MatrixXd Whitened(const RandomTrial& trial, const VectorXd& noise, const MatrixXd& columns) {
  const int width = CoordinatesPerRow(trial.settings.kind);
  MatrixXd whitened = noise.cwiseInverse().asDiagonal() * columns;
  for (Index row = 0; row < trial.motion.num_poses(); ++row) {
    if (!trial.motion.test[static_cast<std::size_t>(row)]) continue;
    whitened.middleRows(width * row, width).setZero();
  }
  return whitened;
}

MatrixXd Beside(const MatrixXd& geometry, const MatrixXd& signals, Index cause) {
  MatrixXd known(geometry.rows(), geometry.cols() + signals.cols());
  known << geometry, signals;
  known.col(geometry.cols() + cause).setZero();
  return known;
}

/// The rows, from 0, that carry most of what is left of a signature.
std::vector<Index> StrongestRows(const VectorXd& left, int width) {
  constexpr std::size_t kFewest = 6;
  constexpr double kShare = 0.03;
  const auto rows = static_cast<std::size_t>(left.size() / width);
  std::vector<Index> order(rows);
  std::iota(order.begin(), order.end(), 0);
  const auto square = [&](Index row) { return left.segment(width * row, width).squaredNorm(); };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return square(a) > square(b); });
  order.resize(std::min(
      rows, std::max(kFewest, static_cast<std::size_t>(kShare * static_cast<double>(rows)))));
  return order;
}

/// A signature that few rows carry looks like outliers: what remains of it without these counts.
Visibility CarriedByMany(VectorXd signal, MatrixXd known, int width, double noise, int parameters) {
  for (const Index row : StrongestRows(WithoutKnown(signal, known), width)) {
    signal.segment(width * row, width).setZero();
    known.middleRows(width * row, width).setZero();
  }
  return VisibilityOf(signal, known, noise, parameters);
}

bool NeedsMasses(const Cause& cause) {
  return cause.effect == "joint_compliance" || cause.effect == "link_bending" ||
         cause.effect == "base_compliance";
}

}  // namespace

VectorXd EffectiveNoise(const RandomTrial& trial) {
  const Settings& s = trial.settings;
  // Whoever is told a larger noise sees less.
  const double said = std::max(1.0, s.sigma_factor);
  RandomTrial standing = trial;
  if (s.kind == Kind::kAdjacent) standing.settings.shared_pose = true;  // as positions
  const World rigid{trial.built, StatedPhysics(trial)};
  const VectorXd quanta = ReadOutQuanta(s, trial.built) / std::sqrt(12.0);
  const MatrixXd levers = Derivatives(standing, rigid, JointMovers(trial.built), kStepOfGeometry);
  VectorXd variance = (levers * quanta.asDiagonal()).rowwise().squaredNorm();
  const bool differences = s.kind == Kind::kAdjacent && !s.shared_pose;
  if (differences) variance *= 2;  // both ends are rounded
  const int width = CoordinatesPerRow(s.kind);
  for (Index k = 0; k < variance.size(); ++k) {
    const double sigma = k % width < 3 ? s.noise : s.noise_rotation;
    variance[k] += said * said * sigma * sigma;
  }
  return variance.cwiseSqrt();
}

void WeighCauses(RandomTrial* trial) {
  if (trial->causes.empty()) return;
  const Settings& s = trial->settings;
  const VectorXd noise = EffectiveNoise(*trial);
  const World rigid{trial->built, StatedPhysics(*trial)};
  const MatrixXd derivatives = Derivatives(*trial, rigid, GeometryMovers(*trial), kStepOfGeometry);
  const MatrixXd constants = RunConstants(*trial);
  MatrixXd geometry(derivatives.rows(), derivatives.cols() + constants.cols());
  if (constants.cols() > 0) {
    geometry << derivatives, constants;
  } else {
    geometry = derivatives;
  }
  geometry = Whitened(*trial, noise, geometry);
  const MatrixXd signals = Whitened(*trial, noise, CauseSignals(*trial));
  const double counts = (1 - s.outliers) / s.repeats;
  for (std::size_t k = 0; k < trial->causes.size(); ++k) {
    Cause& cause = trial->causes[k];
    MatrixXd known = Beside(geometry, signals, static_cast<Index>(k));
    if (cause.like_masses) {
      const World all{trial->built, AllPhysics(*trial)};
      const MatrixXd masses =
          Whitened(*trial, noise, Derivatives(*trial, all, MassMovers(trial->built), kStepOfMass));
      known.conservativeResize(Eigen::NoChange, known.cols() + masses.cols());
      known.rightCols(masses.cols()) = masses;
    }
    // Without masses a load has several unknowns.
    constexpr int kMoments = 3;
    const bool guessed = s.masses != Said::kRight && NeedsMasses(cause);
    const VectorXd signal = signals.col(static_cast<Index>(k));
    const double one = 1 / std::sqrt(counts);
    const int parameters = cause.parameters + (guessed ? kMoments : 0);
    cause.visibility = VisibilityOf(signal, known, one, parameters);
    const Visibility of_many =
        CarriedByMany(signal, known, CoordinatesPerRow(s.kind), one, parameters);
    cause.visibility.power = std::min(cause.visibility.power, of_many.power);
  }
}

}  // namespace dhcal::concealed
