#include "problems/formats/recording/recording_reader.h"

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/robots.h"
#include "tests/support/temp_file.h"

namespace dhcal {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Recording ReadRowsOf(const std::string& path, const std::string& joints, std::string* messages) {
  Diagnostics diagnostics;
  const std::optional<Recording> recording = ReadRecording(path, JointsOf(joints), &diagnostics);
  *messages = diagnostics.ToString();
  EXPECT_TRUE(recording.has_value()) << *messages;
  return recording.value_or(Recording());
}

/// Reads a text that must give no message at all.
Recording ReadRows(const std::string& text, const std::string& joints = "RR") {
  std::string messages;
  const Recording recording = ReadRowsOf(TempFile(text, ".csv").path(), joints, &messages);
  EXPECT_EQ(messages, "");
  return recording;
}

Recording ReadAllColumns() {
  std::string messages;
  return ReadRowsOf(DHCAL_SOURCE_DIR "/tests/data/good/all_columns.csv", "RP", &messages);
}

TEST(RecordingReader, ReadsCoordinatesInSi) {
  const Recording recording = ReadAllColumns();
  ASSERT_EQ(recording.num_rows(), 2);
  ASSERT_EQ(recording.num_joints(), 2);
  EXPECT_THAT(recording.lines, ElementsAre(3, 5));
  EXPECT_TRUE(recording.q.isApprox((Eigen::Matrix2d() << kPi, 0.1, -kPi / 2, 0.2).finished()));
  EXPECT_TRUE(recording.p_WQ.row(0).isApprox(Eigen::RowVector3d(0.001, 0.002, 0.003)));
  EXPECT_TRUE(recording.p_WQ.row(1).isApprox(Eigen::RowVector3d(0.004, 0.005, 0.006)));
  EXPECT_TRUE(recording.displacement.row(1).isApprox(Eigen::RowVector3d(0.003, 0.003, 0.003)));
  EXPECT_DOUBLE_EQ(recording.distance[0], 0.5);
  EXPECT_DOUBLE_EQ(recording.sigma[0], 0.05e-3);
}

TEST(RecordingReader, BlankCellsAreNaN) {
  const Recording recording = ReadAllColumns();
  EXPECT_TRUE(recording.displacement.row(0).array().isNaN().all());
  for (const Eigen::VectorXd& column :
       {recording.distance, recording.sigma, recording.time, recording.payload}) {
    EXPECT_FALSE(std::isnan(column[0]));
    EXPECT_TRUE(std::isnan(column[1]));
  }
}

TEST(RecordingReader, QuaternionsAreNormalised) {
  const Recording recording = ReadAllColumns();
  EXPECT_EQ(recording.quaternion.row(0), Eigen::RowVector4d(1, 0, 0, 0));
  EXPECT_DOUBLE_EQ(recording.quaternion.row(1).norm(), 1.0);
  EXPECT_GT(recording.quaternion(1, 3), recording.quaternion(1, 0));
}

TEST(RecordingReader, ReadsCircumstancesInSi) {
  const Recording recording = ReadAllColumns();
  EXPECT_EQ(recording.time[0], 10);
  EXPECT_EQ(recording.payload[0], 0);
  EXPECT_EQ(recording.temperature.row(0), Eigen::RowVector2d(20.5, 21.5));
  EXPECT_EQ(recording.direction.row(0), Eigen::RowVector2d(1, -1));
  EXPECT_TRUE(recording.speed.row(0).isApprox(Eigen::RowVector2d(kPi / 2, 0.005)));
  EXPECT_EQ(recording.torque.row(0), Eigen::RowVector2d(1.5, -2.5));
}

TEST(RecordingReader, PosesNeedNoJoints) {
  const TempFile file("x_mm,y_mm,z_mm,roll_deg,pitch_deg,yaw_deg\n1,2,3,0,0,90\n");
  Diagnostics diagnostics;
  const auto poses = ReadPoses(file.path(), JointsOf("RRP"), &diagnostics);
  ASSERT_TRUE(poses.has_value()) << diagnostics.ToString();
  ASSERT_EQ(poses->num_rows(), 1);
  EXPECT_EQ(poses->num_joints(), 3);
  EXPECT_TRUE(poses->q.array().isNaN().all());
  EXPECT_TRUE(poses->p_WQ.isApprox(Eigen::RowVector3d(1e-3, 2e-3, 3e-3)));
  // A part of the joints is a mistake.
  const TempFile part("x_mm,y_mm,z_mm,q1_deg\n1,2,3,4\n");
  EXPECT_FALSE(ReadPoses(part.path(), JointsOf("RRP"), &diagnostics).has_value());
  EXPECT_FALSE(ReadRecording(file.path(), JointsOf("RRP"), &diagnostics).has_value());
}

TEST(RecordingReader, ReadsTheHeadAndItsEdge) {
  const Recording recording = ReadAllColumns();
  ASSERT_EQ(recording.head.rows(), 2);
  EXPECT_TRUE(recording.head.row(0).isApprox(Eigen::RowVector3d(7e-3, 8e-3, 9e-3)));
  EXPECT_TRUE(recording.head.row(1).array().isNaN().all());
  EXPECT_THAT(recording.edge_names, ElementsAre("front"));
  EXPECT_THAT(recording.edge_idx, ElementsAre(0, -1));
}

TEST(RecordingReader, LabelsBecomeIndices) {
  const Recording recording = ReadAllColumns();
  EXPECT_THAT(recording.run_names, ElementsAre("morning", "even,ing"));
  EXPECT_THAT(recording.run_idx, ElementsAre(0, 1));
  EXPECT_THAT(recording.target_names, ElementsAre("A", "B"));
  EXPECT_THAT(recording.anchor_names, ElementsAre("west"));
  EXPECT_THAT(recording.anchor_idx, ElementsAre(0, -1));
  EXPECT_THAT(recording.is_test, ElementsAre(false, true));
}

TEST(RecordingReader, OtherNumbersAreKeptAndTextsNamedInOneWarning) {
  std::string messages;
  const Recording recording =
      ReadRowsOf(DHCAL_SOURCE_DIR "/tests/data/good/all_columns.csv", "RP", &messages);
  ASSERT_EQ(recording.extra.size(), 1u);
  EXPECT_EQ(recording.extra[0].name, "humidity");
  EXPECT_EQ(recording.extra[0].values[0], 0.4);
  EXPECT_TRUE(std::isnan(recording.extra[0].values[1]));
  EXPECT_THAT(messages,
              HasSubstr("all_columns.csv:2:1: warning: unknown columns, ignored because of blank "
                        "cells: 'humidity' (first in line 5); columns of text, ignored: "
                        "'operator'\n"));
}

TEST(RecordingReader, UnknownColumnsWithBlankOrNanCellsAreSaidToBeIgnored) {
  std::string messages;
  const Recording recording = ReadRowsOf(
      TempFile("q1_deg,q2_deg,full,blank,nan\n1,2,3,4,5\n1,2,3,,NaN\n").path(), "RR", &messages);
  EXPECT_THAT(messages,
              HasSubstr("unknown columns, kept as possible drivers: 'full'; unknown columns, "
                        "ignored because of blank cells: 'blank' (first in line 3), 'nan' (first "
                        "in line 3)\n"));
  ASSERT_EQ(recording.extra.size(), 3u);
  EXPECT_EQ(recording.extra[2].values[0], 5);
  EXPECT_TRUE(std::isnan(recording.extra[2].values[1]));
}

TEST(RecordingReader, UnknownColumnNamesTheNearestKnownOne) {
  std::string messages;
  ReadRowsOf(TempFile("q1_deg,q2_deg,paylod_kg\n1,2,3\n").path(), "RR", &messages);
  EXPECT_THAT(messages, HasSubstr("'paylod_kg' (did you mean 'payload_kg'?)"));
}

TEST(RecordingReader, AbsentColumnsAreEmpty) {
  const Recording recording = ReadRows("q1_deg,q2_rad\n180,2\n");
  EXPECT_DOUBLE_EQ(recording.q(0, 0), kPi);
  EXPECT_EQ(recording.q(0, 1), 2);
  EXPECT_EQ(recording.p_WQ.rows(), 0);
  EXPECT_EQ(recording.quaternion.rows(), 0);
  EXPECT_EQ(recording.sigma.size(), 0);
  EXPECT_TRUE(recording.run_idx.empty());
  EXPECT_TRUE(recording.is_test.empty());
  EXPECT_TRUE(recording.extra.empty());
}

TEST(RecordingReader, SeriesPerJointMayHaveGaps) {
  const Recording recording = ReadRows("q1_deg,q2_deg,torque2_Nm\n1,2,3\n");
  ASSERT_EQ(recording.torque.cols(), 2);
  EXPECT_TRUE(std::isnan(recording.torque(0, 0)));
  EXPECT_EQ(recording.torque(0, 1), 3);
}

TEST(RecordingReader, OneTemperatureIsOneColumn) {
  const Recording recording = ReadRows("q1_deg,q2_deg,temperature_C\n1,2,23\n");
  ASSERT_EQ(recording.temperature.cols(), 1);
  EXPECT_EQ(recording.temperature(0, 0), 23);
}

TEST(RecordingReader, ColumnOrderIsFree) {
  const Recording recording = ReadRows("z_m,q2_rad,x_m,q1_rad,y_m\n3,5,1,4,2\n");
  EXPECT_EQ(recording.q.row(0), Eigen::RowVector2d(4, 5));
  EXPECT_EQ(recording.p_WQ.row(0), Eigen::RowVector3d(1, 2, 3));
}

TEST(RecordingReader, ByteOrderMarkLineEndsAndBlankLinesChangeNothing) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text = "\xEF\xBB\xBFq1_rad, q2_rad ,run|1,2, a b |  # comment||3,\t4,c||  |";
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|')) {
      text.replace(at, 1, end);
    }
    const Recording recording = ReadRows(text);
    EXPECT_EQ(recording.q, (Eigen::Matrix2d() << 1, 2, 3, 4).finished());
    EXPECT_THAT(recording.run_names, ElementsAre("a b", "c"));
    EXPECT_THAT(recording.lines, ElementsAre(2, 5));
  }
}

TEST(RecordingReader, LinesOfCommasAloneAreBlankLines) {
  const Recording recording = ReadRows(",,\nq1_rad,q2_rad,run\n1,2,a\n,,\n3,4,a\n, ,,,\n,,");
  EXPECT_EQ(recording.q, (Eigen::Matrix2d() << 1, 2, 3, 4).finished());
  EXPECT_THAT(recording.lines, ElementsAre(3, 5));
}

TEST(RecordingReader, LastLineNeedsNoEnd) {
  EXPECT_EQ(ReadRows("q1_rad,q2_rad\n1,2").num_rows(), 1);
}

TEST(RecordingReader, QuotedCellsKeepCommasAndQuotes) {
  const Recording recording =
      ReadRows("\"q1_rad\",q2_rad,run\n\"1\",2,\" a, \"\"b\"\" \"\n1,2,\"\"\"\"\n");
  EXPECT_THAT(recording.run_names, ElementsAre(" a, \"b\" ", "\""));
}

/// Messages about a file of one turning joint and a position, with these words on its columns.
std::string MessagesWith(const std::vector<ColumnAlias>& columns, const std::string& text) {
  const TempFile file(text, ".csv");
  Diagnostics diagnostics;
  ReadRecording(file.path(), JointsOf("R"), columns, &diagnostics);
  return diagnostics.ToString();
}

TEST(RecordingReader, ColumnsOfTheProblemFileComeFirst) {
  const TempFile file("q1_deg,command,x_mm,y_mm,z_mm\n10,20,1,2,3\n11,21,1,2,3\n", ".csv");
  Diagnostics diagnostics;
  const auto recording =
      ReadRecording(file.path(), JointsOf("R"), {{"q1_rad", "command", {}, {}}}, &diagnostics);
  ASSERT_TRUE(recording.has_value()) << diagnostics.ToString();
  EXPECT_EQ(recording->q(0, 0), 20);
  ASSERT_EQ(recording->extra.size(), 1u);
  EXPECT_EQ(recording->extra[0].name, "q1_deg");
}

TEST(RecordingReader, WrongColumnsOfTheProblemFileAreErrorsThere) {
  const SourceLocation ours = {"p.yaml", 7, 3}, theirs = {"p.yaml", 7, 11};
  EXPECT_THAT(
      MessagesWith({{"q1_radd", "command", ours, theirs}}, "q1_deg,command\n1,2\n"),
      HasSubstr("p.yaml:7:3: error: 'q1_radd' is no column of a recording of this robot, did "
                "you mean 'q1_rad'?"));
  EXPECT_THAT(MessagesWith({{"q1_rad", "comand", ours, theirs}}, "q1_deg,command\n1,2\n"),
              HasSubstr("p.yaml:7:11: error: the recording"));
  EXPECT_THAT(MessagesWith({{"q1_rad", "comand", ours, theirs}}, "q1_deg,command\n1,2\n"),
              HasSubstr("has no column 'comand'; did you mean 'command'?"));
}

TEST(RecordingReader, ClockThatStandsIsNotUsed) {
  const std::string text = "q1_deg,t_s\n1,2.02011E+13\n2,2.02011E+13\n";
  const TempFile file(text, ".csv");
  std::string messages;
  EXPECT_EQ(ReadRowsOf(file.path(), "R", &messages).time.size(), 0);
  EXPECT_THAT(messages, HasSubstr("column 't_s' holds the same time in all rows, and is not used"));
}

TEST(RecordingReader, MissingFileIsOneError) {
  Diagnostics diagnostics;
  EXPECT_EQ(ReadRecording("nowhere.csv", JointsOf("RR"), &diagnostics), std::nullopt);
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("nowhere.csv: error: there is no such file"));
}

TEST(RecordingReader, ReportsTheFirstTwentyErrorsAndCountsTheRest) {
  std::string text = "q1_deg,q2_deg\n";
  for (int i = 0; i < 5000; ++i) text += "x,y\n";
  Diagnostics diagnostics;
  EXPECT_EQ(ReadRecording(TempFile(text).path(), JointsOf("RR"), &diagnostics), std::nullopt);
  ASSERT_EQ(diagnostics.num_errors(), 21);
  EXPECT_EQ(diagnostics.all()[19].where.line, 11);
  EXPECT_EQ(diagnostics.all()[20].message, "... and 9980 more errors");
}

TEST(RecordingReader, ReadsTwelveThousandRowsAtOnce) {
  std::string text =
      "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,qw,qx,qy,qz,temperature_C,t_s\n";
  for (int i = 0; i < 12000; ++i) {
    const double s = 0.001 * i;
    text +=
        fmt::format("{:.6f},{:.6f},3.25,-4.125,5.5,-6.5,{:.5f},{:.5f},789.01234,1,0,0,0,23.5,{}\n",
                    s,
                    -s,
                    1000 + s,
                    2000 - s,
                    i);
  }
  const TempFile file(text);
  const auto start = std::chrono::steady_clock::now();
  std::string messages;
  const Recording recording = ReadRowsOf(file.path(), "RRRRRR", &messages);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(recording.num_rows(), 12000);
  EXPECT_DOUBLE_EQ(recording.p_WQ(11999, 0), 1.011999);
  // About 0.02 s; the bound leaves room for a busy machine and for sanitizers.
  EXPECT_LT(seconds.count(), 1.0);
  RecordProperty("milliseconds", static_cast<int>(1000 * seconds.count()));
}

}  // namespace
}  // namespace dhcal
