// Laws of every kind of measurement, over the whole registry: a new kind is held to them without a
// new line here.
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/math/rotation.h"
#include "residuals/measurement.h"
#include "residuals/readings.h"
#include "residuals/registry.h"
#include "tests/support/matchers.h"
#include "tests/support/ridders.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kPoses = 8;

class EveryMeasurement : public testing::TestWithParam<std::string> {
 protected:
  EveryMeasurement() : type_(*FindMeasurementType(GetParam())) {
    Rng rng(7);
    spec_.kind = type_.Describe();
    spec_.anchors = {{"near", Vector3d(2.5, 1, 0)}, {"far", Vector3d(-3, 2, 4)}};
    spec_.head.camera.p_QS = Vector3d(0.02, 0, 0);
    spec_.head.lasers[0].p_QS = Vector3d(-0.03, 0.05, 0.01);
    spec_.head.lasers[1] = {Vector3d(-0.03, -0.05, 0.01), Vector3d(0.1, -0.2, 1).normalized()};
    spec_.head.ruler_height = 0.004;
    for (int k = 0; k < kPoses; ++k) {
      const Vector3d p(rng.Uniform(-1, 1), rng.Uniform(-1, 1), rng.Uniform(-1, 1));
      // Sensors of a head keep seeing the face.
      const Vector3d w(rng.Uniform(-0.7, 0.7), rng.Uniform(-0.7, 0.7), rng.Uniform(-0.7, 0.7));
      poses_.push_back(MakeFrame(p, w));
    }
    recording_.q = MatrixXd::Zero(kPoses, 1);
  }

  void Simulate(double noise, std::uint64_t seed) {
    Rng rng(seed);
    type_.Simulate(spec_, poses_, {noise, noise}, &rng, &recording_);
    measurement_ = type_.Bind(spec_, recording_);
    readings_ = CollectReadings(*measurement_, recording_, spec_.anchored).fitted;
  }

  static SeenPose Seen(const Isometry3d& X) { return {X.translation(), X.linear()}; }
  SeenPose Now(const Reading& reading) const {
    return Seen(poses_[static_cast<std::size_t>(reading.row_idx)]);
  }
  std::optional<SeenPose> Before(const Reading& reading) const {
    if (reading.previous_idx < 0) return std::nullopt;
    return Seen(poses_[static_cast<std::size_t>(reading.previous_idx)]);
  }
  ReadingComparison Compare(const Reading& reading,
                            const SeenPose& now,
                            const std::optional<SeenPose>& before) const {
    ReadingComparison comparison(spec_.kind.num_coordinates());
    EXPECT_TRUE(measurement_->Compare(reading, now, before ? &*before : nullptr, &comparison));
    return comparison;
  }

  const MeasurementType& type_;
  MeasurementSpec spec_;
  std::vector<Isometry3d> poses_;
  Recording recording_;
  std::unique_ptr<Measurement> measurement_;
  std::vector<Reading> readings_;
};

/// A pose moved by a twist: translation added, turned from the left in W.
SeenPose Moved(const SeenPose& pose, const VectorXd& twist) {
  const Vector3d turn = twist.tail<3>();
  return {pose.p_WQ + twist.head<3>(), ExpSO3<double>(turn) * pose.R_WQ};
}

TEST_P(EveryMeasurement, SaysWhatItIs) {
  const MeasurementKind kind = type_.Describe();
  EXPECT_EQ(kind.name, GetParam());
  EXPECT_FALSE(kind.sentence.empty());
  EXPECT_FALSE(kind.noun.empty());
  ASSERT_GE(kind.num_coordinates(), 1);
  ASSERT_LE(kind.num_coordinates(), kMostCoordinates);
  std::set<std::string> names;
  for (int k = 0; k < kind.num_coordinates(); ++k) {
    const MeasuredCoordinate& coordinate = kind.coordinates[static_cast<std::size_t>(k)];
    EXPECT_TRUE(names.insert(coordinate.name).second) << coordinate.name << " twice";
    EXPECT_EQ(coordinate.unit == Unit::kMetre, k < kind.num_lengths()) << "lengths come first";
  }
}

TEST_P(EveryMeasurement, MissesItsColumnsInAnEmptyRecordingAndNothingInItsOwn) {
  Recording empty;
  empty.q = MatrixXd::Zero(kPoses, 1);
  const std::string missing = type_.Bind(spec_, empty)->Missing();
  EXPECT_NE(missing.find("'measurement.kind: " + GetParam() + "' needs"), std::string::npos)
      << missing;
  Simulate(0, 1);
  EXPECT_EQ(measurement_->Missing(), "");
  EXPECT_GE(readings_.size(), static_cast<std::size_t>(kPoses) - 1);
}

TEST_P(EveryMeasurement, ReadingsWithoutNoiseAreWhatThePosesPredict) {
  Simulate(0, 1);
  for (const Reading& reading : readings_) {
    const auto before = Before(reading);
    const ReadingComparison comparison = Compare(reading, Now(reading), before);
    EXPECT_THAT(comparison.difference,
                MatrixNear(VectorXd::Zero(spec_.kind.num_coordinates()), 1e-14));
    const ReadingNumbers numbers =
        measurement_->Numbers(reading, Now(reading), before ? &*before : nullptr);
    EXPECT_THAT(numbers.predicted, MatrixNear(numbers.measured, 1e-14));
  }
}

TEST_P(EveryMeasurement, ReadsWithTheNoiseAskedFor) {
  constexpr double kSigma = 1e-3;
  double squares = 0, count = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    recording_.anchor_idx.clear();
    recording_.anchor_names.clear();
    Simulate(kSigma, seed);
    for (const Reading& reading : readings_) {
      const ReadingComparison comparison = Compare(reading, Now(reading), Before(reading));
      squares += comparison.difference.squaredNorm();
      count += static_cast<double>(comparison.difference.size());
    }
  }
  // A difference of two readings has the errors of both.
  const bool of_two = spec_.kind.pairs && recording_.displacement.rows() == 0;
  // Five standard deviations of the estimate; the errors of series are correlated.
  EXPECT_NEAR(std::sqrt(squares / count) / kSigma,
              of_two ? std::sqrt(2.0) : 1.0,
              (of_two ? 10 : 5) / std::sqrt(2 * count));
}

TEST_P(EveryMeasurement, DerivativesByTwistEqualRiddersDifferences) {
  Simulate(0.05, 3);  // residuals that are not small
  for (const Reading& reading : readings_) {
    const SeenPose now = Now(reading);
    const auto before = Before(reading);
    const ReadingComparison comparison = Compare(reading, now, before);
    const auto by_now = [&](const VectorXd& twist) -> VectorXd {
      return Compare(reading, Moved(now, twist), before).difference;
    };
    EXPECT_THAT(MatrixXd(comparison.by_now),
                MatrixNear(RiddersJacobian(by_now, VectorXd::Zero(6)), 1e-9));
    if (!before) continue;
    const auto by_before = [&](const VectorXd& twist) -> VectorXd {
      return Compare(reading, now, Moved(*before, twist)).difference;
    };
    EXPECT_THAT(MatrixXd(comparison.by_before),
                MatrixNear(RiddersJacobian(by_before, VectorXd::Zero(6)), 1e-9));
  }
}

TEST_P(EveryMeasurement, SeesAnOffsetAndATurnExactlyWhereItSaysSo) {
  Simulate(0, 1);
  MatrixXd shift(0, 3), turn(0, 3);
  for (const Reading& reading : readings_) {
    const ReadingComparison comparison = Compare(reading, Now(reading), Before(reading));
    const MatrixXd both = comparison.by_now + comparison.by_before;
    shift.conservativeResize(shift.rows() + both.rows(), 3);
    shift.bottomRows(both.rows()) = both.leftCols<3>();
    turn.conservativeResize(turn.rows() + both.rows(), 3);
    turn.bottomRows(both.rows()) = comparison.by_now.rightCols<3>();
  }
  EXPECT_EQ(shift.norm() > 1e-9, spec_.kind.sees_offset);
  EXPECT_EQ(turn.norm() > 1e-9, spec_.kind.turns_show());
}

TEST_P(EveryMeasurement, BlankRowsGiveNoReading) {
  Simulate(0, 1);
  const std::size_t all = readings_.size();
  const double blank = std::numeric_limits<double>::quiet_NaN();
  for (MatrixXd* const column :
       {&recording_.p_WQ, &recording_.displacement, &recording_.quaternion, &recording_.head}) {
    if (column->rows() > 0) column->row(3).setConstant(blank);
  }
  if (recording_.distance.size() > 0) recording_.distance[3] = blank;
  EXPECT_EQ(CollectReadings(*measurement_, recording_, false).fitted.size(), all - 1);
}

std::vector<std::string> AllKinds() {
  std::vector<std::string> names;
  for (const MeasurementType* const type : AllMeasurementTypes()) {
    names.push_back(type->Describe().name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Registry,
                         EveryMeasurement,
                         testing::ValuesIn(AllKinds()),
                         [](const auto& test) { return test.param; });

TEST(Distance, HasNoDerivativeAtItsAnchor) {
  MeasurementSpec spec;
  spec.kind = KindNamed("distance");
  spec.anchors = {{"A", Vector3d(1, 2, 3)}};
  Recording recording;
  recording.q = MatrixXd::Zero(1, 1);
  recording.distance = VectorXd::Ones(1);
  recording.anchor_names = {"A"};
  recording.anchor_idx = {0};
  const auto measurement = MakeMeasurement(spec, recording);
  ReadingComparison comparison(1);
  EXPECT_FALSE(measurement->Compare({0, -1}, {Vector3d(1, 2, 3)}, nullptr, &comparison));
}

TEST(StraightEdgeHead, SensorsThatLookAlongTheFaceHaveNoReading) {
  MeasurementSpec spec;
  spec.kind = KindNamed("straight_edge");
  Recording recording;
  recording.q = MatrixXd::Zero(2, 1);
  recording.head = MatrixXd::Zero(2, 3);
  recording.edge_names = {"E"};
  recording.edge_idx = {0, 0};
  const auto measurement = MakeMeasurement(spec, recording);
  ReadingComparison comparison(3);
  const Isometry3d down = MakeFrame({0, 0, 0.06}, {3.14159, 0, 0});
  const Isometry3d along = MakeFrame({0, 0, 0.06}, {1.5707963, 0, 0});
  const auto seen = [](const Isometry3d& X) { return SeenPose{X.translation(), X.linear()}; };
  const SeenPose over = seen(down), beside = seen(along);
  EXPECT_TRUE(measurement->Compare({1, 0}, over, &over, &comparison));
  EXPECT_FALSE(measurement->Compare({1, 0}, beside, &over, &comparison));
  EXPECT_FALSE(measurement->Compare({1, 0}, over, &beside, &comparison));
}

TEST(StraightEdgeHead, PairsNeverCrossARunOrAnEdge) {
  MeasurementSpec spec;
  spec.kind = KindNamed("straight_edge");
  Recording recording;
  recording.q = MatrixXd::Zero(7, 1);
  recording.head = MatrixXd::Ones(7, 3);
  recording.edge_names = {"A", "B"};
  recording.edge_idx = {0, 1, 0, 1, -1, 0, 0};
  recording.run_names = {"first", "second"};
  recording.run_idx = {0, 0, 0, 0, 0, 1, 1};
  const auto measurement = MakeMeasurement(spec, recording);
  std::vector<std::pair<int, int>> pairs;
  for (const Reading& reading : CollectReadings(*measurement, recording, false).fitted) {
    pairs.emplace_back(reading.previous_idx, reading.row_idx);
  }
  const std::vector<std::pair<int, int>> expected = {{0, 2}, {1, 3}, {5, 6}};
  EXPECT_EQ(pairs, expected);
}

}  // namespace
}  // namespace dhcal
