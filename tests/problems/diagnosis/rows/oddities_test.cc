// What is odd about rows that were set aside.
#include "problems/diagnosis/rows/oddities.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/random_matrix.h"

namespace dhcal {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kNoRoundLength = 12.3e-3;  // [m]
constexpr char kNothingOdd[] = "nothing else about it is odd";

Recording SixOrdinaryRows() {
  Rng rng(1);
  Recording recording;
  recording.q = RandomMatrix(6, 4, &rng);
  recording.p_WQ = RandomMatrix(6, 3, &rng);
  return recording;
}

/// What a fit leaves of every row: `size` [m].
std::vector<RowResidual> ThatLieOff(double size, int rows) {
  std::vector<RowResidual> residuals(static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    residuals[static_cast<std::size_t>(row)].row_idx = row;
    residuals[static_cast<std::size_t>(row)].length = size;
  }
  return residuals;
}

/// Why one row was set aside.
std::string ReasonOf(const Recording& recording, int row, double size = kNoRoundLength) {
  std::vector<RowResidual> residuals = ThatLieOff(size, recording.num_rows());
  const std::vector<RowSetAside> described = DescribeSetAside(recording, {row}, &residuals);
  EXPECT_THAT(described, SizeIs(1));
  return described.empty() ? "" : described[0].reason;
}

TEST(DescribeSetAside, AReadingOfNothingButZeros) {
  Recording recording = SixOrdinaryRows();
  recording.p_WQ.row(3).setZero();
  EXPECT_EQ(ReasonOf(recording, 3), "all that was read is zero");
  recording.p_WQ(3, 1) = 1e-6;
  EXPECT_THAT(ReasonOf(recording, 3), HasSubstr(kNothingOdd));
}

TEST(DescribeSetAside, ADistanceOfZeroButNotADisplacement) {
  Recording displaced = SixOrdinaryRows();
  displaced.displacement = displaced.p_WQ;
  displaced.displacement.row(2).setZero();
  displaced.p_WQ.resize(0, 0);
  EXPECT_THAT(ReasonOf(displaced, 2), HasSubstr(kNothingOdd)) << "the robot may have stood";
  Recording distances = SixOrdinaryRows();
  distances.distance = distances.p_WQ.rowwise().norm();
  distances.distance[2] = 0;
  distances.p_WQ.resize(0, 0);
  EXPECT_EQ(ReasonOf(distances, 2), "all that was read is zero");
}

TEST(DescribeSetAside, JointsOfNothingButZeros) {
  Recording recording = SixOrdinaryRows();
  recording.q.row(3).setZero();
  EXPECT_EQ(ReasonOf(recording, 3), "all joint coordinates are zero");
}

TEST(DescribeSetAside, AReadingThatRepeatsThoughTheJointsHaveMoved) {
  Recording recording = SixOrdinaryRows();
  recording.p_WQ.row(3) = recording.p_WQ.row(2);
  EXPECT_EQ(ReasonOf(recording, 3),
            "its reading repeats that of row 3, though the joints have moved");
  recording.q.row(3) = recording.q.row(2);
  EXPECT_THAT(ReasonOf(recording, 3), HasSubstr(kNothingOdd)) << "a pose read twice";
}

TEST(DescribeSetAside, JointsThatRepeatThoughTheReadingDiffers) {
  Recording recording = SixOrdinaryRows();
  recording.q.row(3) = recording.q.row(2);
  EXPECT_EQ(ReasonOf(recording, 3),
            "its joint coordinates repeat those of row 3, though the reading differs");
}

TEST(DescribeSetAside, RepeatsAreThoseOfTheRowBeforeOfTheSameTargetAndAnchor) {
  Recording recording = SixOrdinaryRows();
  // Two targets of each pose: rows 1 and 2, 3 and 4, 5 and 6.
  for (const int row : {1, 3, 5}) recording.q.row(row) = recording.q.row(row - 1);
  recording.target_names = {"A", "B"};
  recording.target_idx = {0, 1, 0, 1, 0, 1};
  EXPECT_THAT(ReasonOf(recording, 3), HasSubstr(kNothingOdd));
  recording.p_WQ.row(3) = recording.p_WQ.row(1);
  EXPECT_THAT(ReasonOf(recording, 3), HasSubstr("repeats that of row 2"));
  recording.anchor_names = {"near", "far"};
  recording.anchor_idx = {0, 0, 0, 1, 0, 0};
  EXPECT_THAT(ReasonOf(recording, 3), HasSubstr(kNothingOdd)) << "no row before of that anchor";
}

TEST(DescribeSetAside, ARoundLengthOff) {
  const Recording recording = SixOrdinaryRows();
  EXPECT_EQ(ReasonOf(recording, 3, 10.02e-3), "it lies a round length off, 10.0 mm");
  EXPECT_EQ(ReasonOf(recording, 3, 4.95e-3), "it lies a round length off, 5.0 mm");
  for (const double size : {10.2e-3, 1e-3, 0.01e-3}) {
    EXPECT_THAT(ReasonOf(recording, 3, size), HasSubstr(kNothingOdd)) << size;
  }
}

TEST(DescribeSetAside, NothingOdd) {
  const Recording recording = SixOrdinaryRows();
  for (int row = 0; row < recording.num_rows(); ++row) {
    EXPECT_EQ(ReasonOf(recording, row), std::string("it lies far off; ") + kNothingOdd);
  }
  EXPECT_EQ(ReasonOf(recording, 3, kNotSet), "it lies far off") << "how far is not known";
}

TEST(DescribeSetAside, EveryRowInItsOrderWithSizeAndSet) {
  Recording recording = SixOrdinaryRows();
  recording.is_test = {false, false, true, false, false, false};
  std::vector<RowResidual> residuals = ThatLieOff(kNoRoundLength, 5);  // none of row 6
  residuals[2].length = 5e-3;
  const std::vector<RowSetAside> described = DescribeSetAside(recording, {2, 4, 5}, &residuals);
  ASSERT_THAT(described, SizeIs(3));
  EXPECT_EQ(described[0].row_idx, 2);
  EXPECT_TRUE(described[0].test);
  EXPECT_EQ(described[0].size, 5e-3);
  EXPECT_EQ(described[1].row_idx, 4);
  EXPECT_FALSE(described[1].test);
  EXPECT_EQ(described[1].size, kNoRoundLength);
  EXPECT_EQ(described[2].row_idx, 5);
  EXPECT_TRUE(std::isnan(described[2].size));
}

TEST(DescribeSetAside, TheReasonStandsInTheResidualsOfTheseRowsOnly) {
  Recording recording = SixOrdinaryRows();
  recording.p_WQ.row(1).setZero();
  std::vector<RowResidual> residuals = ThatLieOff(kNoRoundLength, 6);
  const std::vector<RowSetAside> described = DescribeSetAside(recording, {1, 4}, &residuals);
  ASSERT_THAT(described, SizeIs(2));
  EXPECT_EQ(residuals[1].set_aside, "all that was read is zero");
  EXPECT_EQ(residuals[1].set_aside, described[0].reason);
  EXPECT_EQ(residuals[4].set_aside, described[1].reason);
  for (const std::size_t row : {0, 2, 3, 5}) EXPECT_THAT(residuals[row].set_aside, IsEmpty());
}

TEST(DescribeSetAside, NoRowsNoEntries) {
  std::vector<RowResidual> residuals = ThatLieOff(kNoRoundLength, 6);
  EXPECT_THAT(DescribeSetAside(SixOrdinaryRows(), {}, &residuals), IsEmpty());
  for (const RowResidual& row : residuals) EXPECT_THAT(row.set_aside, IsEmpty());
}

}  // namespace
}  // namespace dhcal
