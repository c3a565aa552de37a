#include "tools/proof/simulator/trial.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tools/proof/simulator/truth.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPosesElsewhere = 200;
constexpr double kHalfRangeElsewhere = 120 * kDegree;

MatrixXd AsMeasured(const Trial& trial, const MatrixXd& rows) {
  return trial.differences ? Differences(rows, trial.motion) : rows;
}

/// What is read of every pose, each column as noisy as the sensor (poses x 3).
MatrixXd Seen(const Trial& trial, const Arm& built, const Physics& physics) {
  if (!trial.head) return TruePositions(built, physics, trial.motion);
  return AlikeNoisy(*trial.head, HeadNumbers(*trial.head, built, physics, trial.motion));
}

MatrixXd OfGeometry(const Trial& trial) {
  if (!trial.head) return GeometrySignatures(trial.drawing, trial.built, trial.motion);
  return HeadSignatures(*trial.head, trial.drawing, trial.built, trial.motion);
}

/// [m] times the noise: what the first pose of each run reads is free, so each run's mean is.
MatrixXd WithoutMeans(const Trial& trial, MatrixXd rows) {
  const auto poses = static_cast<std::size_t>(trial.motion.num_poses());
  for (std::size_t first = 0; first < poses;) {
    std::vector<Index> fitted;
    std::size_t end = first;
    for (; end < poses && trial.motion.run[end] == trial.motion.run[first]; ++end) {
      if (!trial.motion.test[end]) fitted.push_back(3 * static_cast<Index>(end));
    }
    MatrixXd mean = MatrixXd::Zero(3, rows.cols());
    for (const Index row : fitted) mean += rows.middleRows(row, 3);
    mean /= static_cast<double>(std::max<std::size_t>(fitted.size(), 1));
    for (const Index row : fitted) rows.middleRows(row, 3) -= mean;
    first = end;
  }
  return rows;
}

/// What each cause adds to the readings, given the others.
MatrixXd Signals(const Trial& trial) {
  const MatrixXd all = Seen(trial, trial.built, AllPhysics(trial));
  MatrixXd signals(3 * trial.motion.num_poses(), static_cast<Index>(trial.causes.size()));
  for (std::size_t k = 0; k < trial.causes.size(); ++k) {
    const MatrixXd without = Seen(trial, trial.built, PhysicsWithout(trial, k));
    signals.col(static_cast<Index>(k)) = Stacked(all - without);
  }
  return AsMeasured(trial, signals);
}

/// Rows that are fitted.
MatrixXd Fitted(const Trial& trial, const MatrixXd& all_rows) {
  if (trial.differences) return all_rows;
  const MatrixXd rows = trial.head ? WithoutMeans(trial, all_rows) : all_rows;
  MatrixXd fitted(rows.rows(), rows.cols());
  Index filled = 0;
  for (int k = 0; k < trial.motion.num_poses(); ++k) {
    if (trial.motion.test[static_cast<std::size_t>(k)]) continue;
    fitted.middleRows(filled, 3) = rows.middleRows(3 * static_cast<Index>(k), 3);
    filled += 3;
  }
  fitted.conservativeResize(filled, Eigen::NoChange);
  return fitted;
}

MatrixXd KnownBeside(const MatrixXd& geometry, const MatrixXd& signals, Index cause) {
  MatrixXd known(geometry.rows(), geometry.cols() + signals.cols() - 1);
  known.leftCols(geometry.cols()) = geometry;
  Index filled = geometry.cols();
  for (Index k = 0; k < signals.cols(); ++k) {
    if (k != cause) known.col(filled++) = signals.col(k);
  }
  return known;
}

/// What other masses and centres of the links would change, through all physics of the trial.
MatrixXd MassSignatures(const Trial& trial) {
  constexpr double kMassStep = 0.01;  // [kg], [kg m] over the mass
  const Physics physics = AllPhysics(trial);
  MatrixXd signatures(3 * trial.motion.num_poses(), 4 * trial.built.num_joints());
  for (Index k = 0; k < signatures.cols(); ++k) {
    Arm more = trial.built, less = trial.built;
    const auto link = static_cast<std::size_t>(k / 4);
    if (k % 4 == 3) {
      more.links[link].mass += kMassStep;
      less.links[link].mass -= kMassStep;
    } else {
      more.links[link].com[k % 4] += kMassStep;
      less.links[link].com[k % 4] -= kMassStep;
    }
    signatures.col(k) = Stacked(Seen(trial, more, physics) - Seen(trial, less, physics));
  }
  return AsMeasured(trial, signatures);
}

void Weigh(Trial* trial, const MatrixXd& geometry) {
  const MatrixXd signals = Fitted(*trial, Signals(*trial));
  for (std::size_t k = 0; k < trial->causes.size(); ++k) {
    const auto column = static_cast<Index>(k);
    Cause& cause = trial->causes[k];
    MatrixXd known = KnownBeside(geometry, signals, column);
    if (cause.like_masses) {
      const MatrixXd masses = Fitted(*trial, MassSignatures(*trial));
      known.conservativeResize(Eigen::NoChange, known.cols() + masses.cols());
      known.rightCols(masses.cols()) = masses;
    }
    cause.visibility =
        VisibilityOf(signals.col(column), known, trial->sensor.noise, cause.parameters);
  }
}

}  // namespace

const char* ToString(Group group) {
  switch (group) {
    case Group::kNull:
      return "null";
    case Group::kSingle:
      return "single";
    case Group::kSeveral:
      return "several";
    case Group::kConcealed:
      return "concealed";
    case Group::kOutside:
      return "outside";
  }
  return "";
}

Physics AllPhysics(const Trial& trial) { return PhysicsWithout(trial, trial.causes.size()); }

Physics PhysicsWithout(const Trial& trial, std::size_t cause) {
  Physics physics(trial.built.num_joints());
  physics.head.ruler_scale = trial.ruler_scale;
  for (std::size_t k = 0; k < trial.causes.size(); ++k) {
    if (k != cause) trial.causes[k].apply(&physics, 1);
  }
  return physics;
}

void WeighCauses(Trial* trial) {
  if (trial->causes.empty()) return;
  const MatrixXd geometry = Fitted(*trial, AsMeasured(*trial, OfGeometry(*trial)));
  Weigh(trial, geometry);
  if (trial->wanted_lambda <= 0 || trial->causes.size() != 1) return;
  Cause& cause = trial->causes.front();
  const double scale = std::sqrt(trial->wanted_lambda / cause.visibility.lambda);
  for (auto& [name, value] : cause.values) value *= scale;
  cause.apply = [apply = cause.apply, scale](Physics* physics, double more) {
    apply(physics, scale * more);
  };
  Weigh(trial, geometry);
}

Elsewhere TrueErrorElsewhere(const Trial& trial) {
  Rng rng(trial.seed + 900001);
  Arm around = trial.drawing;
  for (Index j = 0; j < trial.motion.q.cols(); ++j) {
    around.middle[j] = (trial.motion.q.col(j).minCoeff() + trial.motion.q.col(j).maxCoeff()) / 2;
  }
  const Motion there =
      RandomPoses(around,
                  VectorXd::Constant(trial.built.num_joints(), kHalfRangeElsewhere),
                  kPosesElsewhere,
                  &rng);
  const Physics all = AllPhysics(trial), rigid(trial.built.num_joints());
  const auto signal = [&](const Motion& motion) {
    return Stacked(TruePositions(trial.built, all, motion) -
                   TruePositions(trial.built, rigid, motion));
  };
  return ErrorElsewhere(GeometrySignatures(trial.drawing, trial.built, trial.motion),
                        signal(trial.motion),
                        GeometrySignatures(trial.drawing, trial.built, there),
                        signal(there),
                        trial.sensor.noise);
}

MatrixXd Readings(const Trial& trial) {
  Rng rng(trial.noise_seed);
  Motion reached = trial.motion;
  for (Index row = 0; trial.joint_band > 0 && row < reached.q.rows(); ++row) {
    for (Index j = 0; j < reached.q.cols(); ++j) {
      reached.q(row, j) += rng.Uniform(-trial.joint_band, trial.joint_band);
    }
  }
  if (!trial.head) {
    return Read(trial.sensor, TruePositions(trial.built, AllPhysics(trial), reached), &rng);
  }
  MatrixXd numbers = HeadNumbers(*trial.head, trial.built, AllPhysics(trial), reached);
  for (Index row = 0; row < numbers.rows(); ++row) {
    numbers(row, 0) += trial.head->camera_noise * rng.Normal();
    for (int k = 1; k < 3; ++k) numbers(row, k) += trial.head->laser_noise * rng.Normal();
  }
  return numbers;
}

}  // namespace dhcal::concealed
