// Repeats of a pose are one draw where nothing moved between them.
#include "problems/diagnosis/rows/repeats.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;

/// Poses in turn, `cycles` times, each reading with its own error.
Recording Cycles(int poses, int cycles, Rng* rng) {
  Recording recording;
  recording.q.resize(poses * cycles, 6);
  recording.p_WQ.resize(poses * cycles, 3);
  for (int k = 0; k < poses * cycles; ++k) {
    for (int j = 0; j < 6; ++j) {
      recording.q(k, j) = std::sin(7.0 * (k % poses) + j) + 1e-7 * rng->Normal();
    }
    for (int i = 0; i < 3; ++i) recording.p_WQ(k, i) = k % poses + 1e-3 * rng->Normal();
  }
  return recording;
}

TEST(PutRepeatsTogether, APoseReadTenTimesIsOneRow) {
  Rng rng(2);
  const Recording recording = Cycles(12, 10, &rng);
  const DistinctRows distinct =
      PutRepeatsTogether(recording, MatrixXd::Ones(recording.num_rows(), 6));
  EXPECT_TRUE(distinct.averaged);
  ASSERT_EQ(distinct.recording.num_rows(), 12);
  EXPECT_EQ(distinct.original[3].size(), 10);
  EXPECT_NEAR(distinct.recording.p_WQ(3, 0), 3, 2e-3);
  EXPECT_EQ(distinct.recording.direction.rows(), 12);
}

TEST(PutRepeatsTogether, OneWildRepeatDoesNotMoveThePose) {
  Rng rng(3);
  Recording recording = Cycles(12, 10, &rng);
  recording.p_WQ(15, 1) += 50;
  const DistinctRows distinct =
      PutRepeatsTogether(recording, MatrixXd::Zero(recording.num_rows(), 6));
  EXPECT_NEAR(distinct.recording.p_WQ(3, 1), 3, 2e-3);
}

TEST(PutRepeatsTogether, RowsOfOtherRunsAndSetsStayApart) {
  Rng rng(4);
  Recording recording = Cycles(6, 10, &rng);
  recording.run_names = {"a", "b"};
  for (int k = 0; k < recording.num_rows(); ++k) {
    recording.run_idx.push_back(k % 60 < 30 ? 0 : 1);
    recording.is_test.push_back(false);
  }
  const DistinctRows distinct =
      PutRepeatsTogether(recording, MatrixXd::Zero(recording.num_rows(), 6));
  EXPECT_EQ(distinct.recording.num_rows(), 12);
}

TEST(PutRepeatsTogether, LeavesARecordingOfDistinctPosesAlone) {
  Rng rng(5);
  const Recording recording = Cycles(40, 1, &rng);
  const DistinctRows distinct = PutRepeatsTogether(recording, MatrixXd::Zero(40, 6));
  EXPECT_FALSE(distinct.averaged);
  EXPECT_EQ(distinct.recording.q, recording.q);
}

TEST(PutRepeatsTogether, LeavesDifferencesAsTheyAre) {
  Rng rng(9);
  Recording recording = Cycles(12, 10, &rng);
  recording.displacement.swap(recording.p_WQ);
  const DistinctRows distinct = PutRepeatsTogether(recording, MatrixXd::Zero(120, 6));
  EXPECT_FALSE(distinct.averaged);
  EXPECT_EQ(distinct.original.size(), 120);
}

/// In each of so many poses, what is measured moves by twice a row's noise in the middle of the
/// recording, each pose's along a direction of its own.
Recording WithAStep(int poses, int cycles, Rng* rng) {
  Recording recording = Cycles(poses, cycles, rng);
  const int first = recording.num_rows() / 2 + poses / 3;
  for (int k = first; k < recording.num_rows(); ++k) {
    const int pose = k % poses;
    recording.p_WQ.row(k) +=
        2e-3 * Eigen::RowVector3d(std::sin(5.0 * pose), std::cos(5.0 * pose), 1);
  }
  return recording;
}

TEST(PutRepeatsTogether, VisitsBetweenWhichSomethingMovedStayApart) {
  for (const int cycles : {4, 6, 10, 30}) {
    Rng rng(6);
    const int poses = 240 / cycles;
    const Recording recording = WithAStep(poses, cycles, &rng);
    const DistinctRows distinct =
        PutRepeatsTogether(recording, MatrixXd::Zero(recording.num_rows(), 6));
    EXPECT_FALSE(distinct.averaged) << cycles << " cycles";
  }
}

TEST(PutRepeatsTogether, TwoOrThreeVisitsCannotTellAndStayApart) {
  for (const int cycles : {2, 3}) {
    Rng rng(7);
    const Recording recording = Cycles(60, cycles, &rng);
    EXPECT_FALSE(PutRepeatsTogether(recording, MatrixXd::Zero(60 * cycles, 6)).averaged);
  }
}

TEST(PutRepeatsTogether, ReadingsOneAfterTheOtherAreOneVisit) {
  Rng rng(8);
  const Recording cycles = Cycles(30, 3, &rng);
  const Eigen::ArrayXi twice = Eigen::ArrayXi::LinSpaced(180, 0, 179) / 2;
  Recording recording = cycles;
  recording.q = cycles.q(twice, Eigen::all);
  recording.p_WQ = cycles.p_WQ(twice, Eigen::all);
  const DistinctRows distinct = PutRepeatsTogether(recording, MatrixXd::Zero(180, 6));
  EXPECT_TRUE(distinct.averaged);
  ASSERT_EQ(distinct.recording.num_rows(), 90);
  EXPECT_EQ(distinct.original[31], (std::vector<int>{62, 63}));
}

TEST(PutRepeatsTogether, NoiseKeepsVisitsApartOnceInManyRecordings) {
  int times = 0;
  for (int seed = 0; seed < 300; ++seed) {
    Rng rng(100 + static_cast<std::uint64_t>(seed));
    const int cycles = 4 + seed % 5;
    const Recording recording = Cycles(20, cycles, &rng);
    times += PutRepeatsTogether(recording, MatrixXd::Zero(20 * cycles, 6)).averaged ? 0 : 1;
  }
  EXPECT_LE(times, 1);
}

}  // namespace
}  // namespace dhcal
