#include <cmath>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "problems/formats/recording/recording_reader.h"
#include "problems/formats/result/result_writer.h"
#include "tests/support/comma_locale.h"
#include "tests/support/example_result.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Two joints, the second prismatic.
RobotModel TwoJointRobot() {
  RobotModel robot;
  robot.joints.resize(2);
  robot.joints[0].name = "turn";
  robot.joints[1].name = "slide";
  robot.joints[1].type = JointType::kPrismatic;
  return robot;
}

/// Numbers of all sizes with all their digits.
Eigen::MatrixXd Random(int rows, int columns, Rng* rng) {
  Eigen::MatrixXd matrix(rows, columns);
  for (double& value : matrix.reshaped()) {
    value = rng->Normal() * std::pow(10.0, rng->Uniform(-12, 3));
  }
  return matrix;
}

/// Every column that a recording can have.
Recording FullRecording() {
  constexpr int kRowsOfAll = 40;
  Rng rng(20240607);
  Recording recording;
  recording.q = Random(kRowsOfAll, 2, &rng);
  recording.p_WQ = Random(kRowsOfAll, 3, &rng);
  recording.p_WQ.row(4).setConstant(kNotSet);
  recording.displacement = Random(kRowsOfAll, 3, &rng);
  recording.displacement.row(0).setConstant(kNotSet);
  recording.quaternion = Random(kRowsOfAll, 4, &rng).rowwise().normalized();
  recording.distance = Random(kRowsOfAll, 1, &rng).cwiseAbs();
  recording.head = Random(kRowsOfAll, 3, &rng);
  recording.head.row(6).setConstant(kNotSet);
  recording.sigma = Random(kRowsOfAll, 1, &rng).cwiseAbs();
  recording.time = Random(kRowsOfAll, 1, &rng);
  recording.payload = Random(kRowsOfAll, 1, &rng).cwiseAbs();
  recording.temperature = Random(kRowsOfAll, 2, &rng);
  recording.direction = Eigen::MatrixXd::Zero(kRowsOfAll, 2);
  recording.direction(3, 0) = -1;
  recording.direction(3, 1) = 1;
  recording.speed = Random(kRowsOfAll, 2, &rng);
  recording.torque = Random(kRowsOfAll, 2, &rng);
  recording.run_names = {"first, with comma", "\"second\""};
  recording.target_names = {"#1", "\u00dcber"};
  recording.anchor_names = {"post"};
  recording.edge_names = {"low", "high"};
  for (int i = 0; i < kRowsOfAll; ++i) {
    recording.run_idx.push_back(i < 15 ? 0 : 1);
    recording.target_idx.push_back(i % 2);
    recording.anchor_idx.push_back(i % 3 == 0 ? -1 : 0);
    recording.edge_idx.push_back(i == 7 ? -1 : i < 12 ? 0 : 1);
    recording.is_test.push_back(i % 5 == 0);
  }
  recording.extra = {{"humidity", Random(kRowsOfAll, 1, &rng)}};
  return recording;
}

/// Same size, and the same bits or both blank everywhere.
void ExpectSame(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const char* what) {
  ASSERT_EQ(a.rows(), b.rows()) << what;
  ASSERT_EQ(a.cols(), b.cols()) << what;
  for (int i = 0; i < a.rows(); ++i) {
    for (int j = 0; j < a.cols(); ++j) {
      const bool same = a(i, j) == b(i, j) || (std::isnan(a(i, j)) && std::isnan(b(i, j)));
      EXPECT_TRUE(same) << what << " (" << i << ", " << j << ")";
    }
  }
}

void ExpectSame(const Recording& a, const Recording& b) {
  ExpectSame(a.q, b.q, "q");
  ExpectSame(a.p_WQ, b.p_WQ, "p_WQ");
  ExpectSame(a.displacement, b.displacement, "displacement");
  ExpectSame(a.distance, b.distance, "distance");
  ExpectSame(a.head, b.head, "head");
  ExpectSame(a.sigma, b.sigma, "sigma");
  ExpectSame(a.time, b.time, "time");
  ExpectSame(a.payload, b.payload, "payload");
  ExpectSame(a.temperature, b.temperature, "temperature");
  ExpectSame(a.direction, b.direction, "direction");
  ExpectSame(a.speed, b.speed, "speed");
  ExpectSame(a.torque, b.torque, "torque");
  // The reader normalises again, which may move the last bit.
  EXPECT_TRUE(a.quaternion.isApprox(b.quaternion, 1e-15));
  EXPECT_EQ(a.run_names, b.run_names);
  EXPECT_EQ(a.run_idx, b.run_idx);
  EXPECT_EQ(a.target_names, b.target_names);
  EXPECT_EQ(a.target_idx, b.target_idx);
  EXPECT_EQ(a.anchor_names, b.anchor_names);
  EXPECT_EQ(a.anchor_idx, b.anchor_idx);
  EXPECT_EQ(a.edge_names, b.edge_names);
  EXPECT_EQ(a.edge_idx, b.edge_idx);
  EXPECT_EQ(a.is_test, b.is_test);
  ASSERT_EQ(a.extra.size(), b.extra.size());
  EXPECT_EQ(a.extra[0].name, b.extra[0].name);
  ExpectSame(a.extra[0].values, b.extra[0].values, "extra");
}

TEST(RecordingToCsv, ReadsBackToTheLastBit) {
  const TempFolder folder;
  const Recording recording = FullRecording();
  const RobotModel robot = TwoJointRobot();
  WriteFile(folder / "recording.csv", RecordingToCsv(recording, robot));
  Diagnostics diagnostics;
  const std::optional<Recording> read =
      ReadRecording(folder / "recording.csv", robot.joints, &diagnostics);
  ASSERT_TRUE(read.has_value()) << diagnostics.ToString();
  ExpectSame(recording, *read);
}

TEST(RecordingToCsv, NamesColumnsByJointTypeInSiUnits) {
  const std::string csv = RecordingToCsv(FullRecording(), TwoJointRobot());
  EXPECT_THAT(csv,
              StartsWith("q1_rad,q2_m,x_m,y_m,z_m,dx_m,dy_m,dz_m,qw,qx,qy,qz,distance_m,ruler_m,"
                         "height1_m,height2_m,sigma_m,t_s,payload_kg,anchor,edge,target,run,set,"
                         "dir1,dir2,qd1_rad_s,qd2_m_s,"
                         "torque1_Nm,torque2_N,temperature1_C,temperature2_C,humidity\n"));
}

TEST(RecordingToCsv, LeavesOutColumnsThatAreAbsent) {
  Recording recording;
  recording.q = Eigen::MatrixXd::Constant(1, 2, 0.5);
  recording.p_WQ = Eigen::MatrixXd::Constant(1, 3, 1.0);
  recording.temperature = Eigen::MatrixXd::Constant(1, 1, 21.5);
  EXPECT_EQ(RecordingToCsv(recording, TwoJointRobot()),
            "q1_rad,q2_m,x_m,y_m,z_m,temperature_C\n0.5,0.5,1,1,1,21.5\n");
}

TEST(RecordingToCsv, QuotesLabels) {
  const std::string csv = RecordingToCsv(FullRecording(), TwoJointRobot());
  EXPECT_THAT(csv, HasSubstr(",\"first, with comma\","));
  EXPECT_THAT(csv, HasSubstr(",\"\"\"second\"\"\","));
}

TEST(RecordingToCsv, IsTheSameUnderACommaDecimalLocale) {
  const std::string expected = RecordingToCsv(FullRecording(), TwoJointRobot());
  const CommaLocale locale;
  EXPECT_EQ(RecordingToCsv(FullRecording(), TwoJointRobot()), expected);
}

}  // namespace
}  // namespace dhcal
