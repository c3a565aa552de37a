// What the oracle says can be seen, where it can be told by hand.

#include "tools/proof/simulator/random/oracle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tools/proof/simulator/arms.h"
#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/random/observe.h"
#include "tools/proof/simulator/random/poses.h"
#include "tools/proof/simulator/truth.h"

namespace dhcal::concealed {
namespace {

using Eigen::Vector3d;

/// A KR 15 read at random poses, with a fine mesh error of joint 1, which no geometry imitates.
RandomTrial MeshTrial(Kind kind = Kind::kPosition, int repeats = 1) {
  RandomTrial trial;
  Settings& s = trial.settings;
  s.kind = kind;
  s.rows = 400 * repeats;
  s.repeats = repeats;
  s.decimals = 6;
  s.noise = 30e-6;
  Rng rng(5);
  trial.drawing = KukaKr15();
  trial.stated = trial.built = trial.drawing;
  trial.motion = DrawMotion(s, trial.drawing, &rng);
  for (const Vector3d& anchor : {Vector3d(3, 0, 0), Vector3d(0, 3, 1), Vector3d(-2, -2, 2)}) {
    trial.anchors.push_back(anchor);
  }
  for (int row = 0; row < trial.motion.num_poses(); ++row) trial.anchor.push_back(row % 3);
  trial.causes = {GearErrs(1, 97.3, 1e-4, 0.4)};
  return trial;
}

/// Squares of the error over the noise, by hand: an angle times the distance from axis 1.
double LambdaByHand(const RandomTrial& trial) {
  const Eigen::MatrixXd p = TruePositions(trial.built, StatedPhysics(trial), trial.motion);
  double sum = 0;
  for (Eigen::Index row = 0; row < p.rows(); ++row) {
    const double angle = 1e-4 * std::sin(97.3 * trial.motion.q(row, 0) + 0.4);
    sum += std::pow(angle * p.row(row).head<2>().norm() / trial.settings.noise, 2);
  }
  return sum;
}

double LambdaOf(RandomTrial trial) {
  WeighCauses(&trial);
  return trial.causes[0].visibility.lambda;
}

TEST(Oracle, SeesAMeshErrorAsTheSumOfItsSquares) {
  // The 33 freedoms of the geometry take their share of 1200 coordinates by chance.
  const RandomTrial trial = MeshTrial();
  EXPECT_NEAR(LambdaOf(trial) / LambdaByHand(trial), 1 - 33 / 1200.0, 0.05);
}

TEST(Oracle, CountsRepeatsAsOneAndOutliersAsLost) {
  RandomTrial trial = MeshTrial(Kind::kPosition, 3);
  const double lambda = LambdaOf(trial);
  EXPECT_NEAR(lambda / (LambdaByHand(trial) / 3), 1, 0.07);
  trial.settings.outliers = 0.1;
  EXPECT_NEAR(LambdaOf(trial) / lambda, 0.9, 1e-9);
}

TEST(Oracle, ALargerNoiseThanTrueBlindsASmallerDoesNot) {
  RandomTrial trial = MeshTrial();
  const double lambda = LambdaOf(trial);
  trial.settings.sigma_factor = 2;
  EXPECT_NEAR(LambdaOf(trial) / lambda, 0.25, 1e-3);
  trial.settings.sigma_factor = 0.5;
  EXPECT_NEAR(LambdaOf(trial) / lambda, 1, 1e-3);
}

TEST(Oracle, TestRowsSayNothing) {
  RandomTrial trial = MeshTrial();
  const double lambda = LambdaOf(trial);
  for (std::size_t k = 0; k < trial.motion.test.size(); k += 2) trial.motion.test[k] = true;
  EXPECT_NEAR(LambdaOf(trial) / lambda, 0.5, 0.1);
}

TEST(Oracle, WhatTheGeometryDoesIsInvisible) {
  RandomTrial trial = MeshTrial();
  trial.causes = {Coupled(1, 2, 0)};
  trial.causes[0].apply = [](Physics* physics, double scale) {
    physics->steps.push_back({2, 0, scale * 1e-4, Vector3d::Zero(), {}});  // from the first row on
  };
  WeighCauses(&trial);
  EXPECT_LT(trial.causes[0].visibility.visible_rms, 1e-3);
  EXPECT_GT(trial.causes[0].visibility.raw_rms, 1);
}

TEST(Oracle, WhatAFewRowsCarryLooksLikeOutliers) {
  // A joint that is off by much in four rows, or by fewer squares in a hundred.
  const auto off = [](int every, double angle) {
    RandomTrial trial = MeshTrial();
    for (Eigen::Index row = 0; row < trial.motion.q.rows(); ++row) {
      trial.motion.q(row, 0) = row % every == 0 ? 2.0 + 1e-3 * static_cast<double>(row % 7)
                                                : trial.motion.q(row, 0) * 0.4;
    }
    trial.causes[0].apply = [=](Physics* physics, double scale) {
      physics->drives[0].form = [=](double q) { return q > 1.9 ? scale * angle : 0.0; };
    };
    WeighCauses(&trial);
    return trial.causes[0].visibility;
  };
  const Visibility few = off(100, 1e-3), many = off(4, 2e-4);
  EXPECT_GT(few.lambda, many.lambda);
  EXPECT_LT(few.power, 0.5);
  EXPECT_GT(many.power, 0.99);
}

TEST(EffectiveNoise, HoldsWhatTheMissingDigitsDo) {
  RandomTrial trial = MeshTrial();
  trial.settings.decimals = 2;
  const Eigen::VectorXd noise = EffectiveNoise(trial);
  const double quantum = 0.01 * kDegree / std::sqrt(12.0);
  // Vertical readings, by a column of levers: joints 2 to 6, by finite differences of positions.
  const Eigen::MatrixXd at = TruePositions(trial.built, StatedPhysics(trial), trial.motion);
  double variance = std::pow(trial.settings.noise, 2);
  constexpr double kStep = 1e-6;
  for (Eigen::Index joint = 0; joint < 6; ++joint) {
    Motion moved = trial.motion;
    moved.q.col(joint).array() += kStep;
    const double lever =
        (TruePositions(trial.built, StatedPhysics(trial), moved)(7, 2) - at(7, 2)) / kStep;
    variance += std::pow(lever * quantum, 2);
  }
  EXPECT_NEAR(noise[7 * 3 + 2] / std::sqrt(variance), 1, 1e-3);
}

TEST(Observing, DistancesSeeWhatLiesAlongTheLine) {
  const RandomTrial trial = MeshTrial(Kind::kDistance);
  const auto poses = TruePoses(trial.built, StatedPhysics(trial), trial.motion);
  auto moved = poses;
  const Vector3d shift(1e-6, -2e-6, 3e-6);
  for (Eigen::Isometry3d& pose : moved) pose.translation() += shift;
  const Eigen::VectorXd change =
      Observe(trial, moved, poses, {}) - Observe(trial, poses, poses, {});
  for (std::size_t k = 0; k < 30; ++k) {
    const Vector3d line = (poses[k].translation() - trial.anchors[k % 3]).normalized();
    EXPECT_NEAR(change[static_cast<Eigen::Index>(k)], line.dot(shift), 1e-11);
  }
}

TEST(Observing, AnInstrumentThatGrowsReadsAllLengthsLonger) {
  const Instrument grown{0, 1e-4, 1};  // long before the second row
  RandomTrial trial = MeshTrial();
  const auto poses = TruePoses(trial.built, StatedPhysics(trial), trial.motion);
  const Eigen::VectorXd positions = Observe(trial, poses, poses, grown);
  EXPECT_NEAR(positions[0], poses[0].translation().x(), 1e-15) << "it is cold at first";
  EXPECT_NEAR(positions[3 * 7 + 2], (1 + 1e-4) * poses[7].translation().z(), 1e-12);
  trial.settings.kind = Kind::kDistance;
  const double distance = (poses[7].translation() - trial.anchors[7 % 3]).norm();
  EXPECT_NEAR(Observe(trial, poses, poses, grown)[7], (1 + 1e-4) * distance, 1e-12);
}

TEST(Observing, PosesSeeRotationsAndDifferencesTheRowBefore) {
  const RandomTrial trial = MeshTrial(Kind::kPose);
  const auto poses = TruePoses(trial.built, StatedPhysics(trial), trial.motion);
  auto turned = poses;
  turned[3].linear() =
      Displacement(Vector3d(1e-4, 0, -2e-4), Vector3d::Zero()).linear() * poses[3].linear();
  const Eigen::VectorXd seen = Observe(trial, turned, poses, {});
  EXPECT_NEAR(seen[3 * 6 + 3], 1e-4, 1e-10);
  EXPECT_NEAR(seen[3 * 6 + 5], -2e-4, 1e-10);
  RandomTrial adjacent = MeshTrial(Kind::kAdjacent);
  adjacent.settings.shared_pose = false;
  const Eigen::VectorXd differences = Observe(adjacent, poses, poses, {});
  EXPECT_EQ(differences[0], 0) << "the first row has none before";
  EXPECT_NEAR(differences[5], poses[1].translation().z() - poses[0].translation().z(), 1e-15);
}

}  // namespace
}  // namespace dhcal::concealed
