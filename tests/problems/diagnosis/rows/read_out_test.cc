// Read-out of the joints.
#include "problems/diagnosis/rows/read_out.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

bool IsExact(const ReadOut& read_out) {
  return read_out.quantum.isZero(0) && read_out.level.isZero(0);
}

TEST(ReadOut, AreTheLastDigitOfDegreesAndMillimetres) {
  const RobotModel scara = Scara();
  Rng rng(1);
  Recording recording;
  recording.q.resize(30, scara.num_joints());
  for (int k = 0; k < 30; ++k) {
    recording.q(k, 0) = std::round(rng.Uniform(-100, 100) * 100) / 100 * kDegree;
    recording.q(k, 1) = rng.Uniform(-2, 2);
    recording.q(k, 2) = std::round(rng.Uniform(-100, 100) * 10) / 10 * kMillimetre;
    recording.q(k, 3) = std::round(rng.Uniform(-2, 2) * 1000) / 1000;  // radians
  }
  const Eigen::VectorXd quanta = ReadOutOf(recording, scara).quantum;
  EXPECT_NEAR(quanta[0], 0.01 * kDegree, 1e-15);
  EXPECT_EQ(quanta[1], 0) << "as many digits as a double has";
  EXPECT_NEAR(quanta[2], 0.1 * kMillimetre, 1e-15);
  EXPECT_NEAR(quanta[3], 1e-3, 1e-15);
}

TEST(ReadOut, AGridWasCommanded) {
  Rng rng(5);
  for (const double step : {10.0, 12.5, 0.25}) {
    Recording recording;
    recording.q.resize(120, 6);
    for (int k = 0; k < recording.num_rows(); ++k) {
      for (int j = 0; j < 6; ++j) {
        recording.q(k, j) = (std::floor(rng.Uniform(0, 6)) - 3) * step * kDegree;
      }
    }
    EXPECT_TRUE(IsExact(ReadOutOf(recording, Kr15()))) << step;
  }
}

TEST(ReadOut, PlacesThatTheLastDigitDoesNotHoldWereRounded) {
  Rng rng(8);
  Recording recording;
  recording.q.resize(120, 6);
  for (int k = 0; k < recording.num_rows(); ++k) {
    for (int j = 0; j < 6; ++j) {
      const double place = -100 + 200 * std::floor(rng.Uniform(0, 7)) / 6;
      recording.q(k, j) = (j == 3 ? place : std::round(place * 100) / 100) * kDegree;
    }
  }
  const ReadOut read_out = ReadOutOf(recording, Kr15());
  EXPECT_TRUE(read_out.quantum.isZero(0));
  for (int j = 0; j < 6; ++j) {
    EXPECT_NEAR(read_out.level[j], j == 3 ? 0 : 0.01 * kDegree, 1e-15) << j;
  }
}

TEST(ReadOut, WholeDegreesWereCommanded) {
  Rng rng(6);
  Recording recording;
  recording.q.resize(80, 6);
  for (double& q : recording.q.reshaped()) q = std::round(rng.Uniform(-100, 100)) * kDegree;
  EXPECT_TRUE(IsExact(ReadOutOf(recording, Kr15())));
}

TEST(ReadOut, FewPosesReadOftenAreStillRounded) {
  Rng rng(7);
  Recording recording;
  recording.q.resize(400, 6);
  for (int k = 0; k < recording.num_rows(); ++k) {
    for (int j = 0; j < 6; ++j) {
      recording.q(k, j) = k >= 40 ? recording.q(k % 40, j)
                                  : std::round(rng.Uniform(-100, 100) * 100) / 100 * kDegree;
    }
  }
  EXPECT_NEAR(ReadOutOf(recording, Kr15()).quantum[2], 0.01 * kDegree, 1e-15);
}

TEST(ReadOut, AJointThatStandsStillWasNotRounded) {
  Recording recording;
  recording.q = Eigen::MatrixXd::Zero(5, 6);
  EXPECT_TRUE(IsExact(ReadOutOf(recording, Kr15())));
}

}  // namespace
}  // namespace dhcal
