#include "problems/formats/recording/recording_orientation.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/robots.h"
#include "tests/support/temp_file.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

/// Elementary turns, written out.
Eigen::Matrix3d TurnX(double t) {
  Eigen::Matrix3d R;
  R << 1, 0, 0, 0, std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t);
  return R;
}
Eigen::Matrix3d TurnY(double t) {
  Eigen::Matrix3d R;
  R << std::cos(t), 0, std::sin(t), 0, 1, 0, -std::sin(t), 0, std::cos(t);
  return R;
}
Eigen::Matrix3d TurnZ(double t) {
  Eigen::Matrix3d R;
  R << std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t), 0, 0, 0, 1;
  return R;
}

/// The orientation that a file of one row with these columns holds; the file's messages.
Eigen::Matrix3d ReadRotation(const std::string& columns,
                             const std::string& cells,
                             std::string* messages = nullptr) {
  const TempFile file("q1_deg," + columns + "\n1," + cells + "\n", ".csv");
  Diagnostics diagnostics;
  const auto recording = ReadRecording(file.path(), JointsOf("R"), &diagnostics);
  if (messages != nullptr) *messages = diagnostics.ToString();
  if (!recording || recording->quaternion.rows() != 1) return Eigen::Matrix3d::Zero();
  const Eigen::RowVector4d q = recording->quaternion.row(0);
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

std::string ThreeDegrees(const Eigen::Vector3d& angles) {
  return fmt::format("{},{},{}", angles.x() / kDegree, angles.y() / kDegree, angles.z() / kDegree);
}

const Eigen::Vector3d kAngles(0.3, -0.7, 2.1);  // [rad]

TEST(RecordingOrientation, RpyTurnsAboutFixedAxes) {
  const Eigen::Matrix3d R = TurnZ(kAngles.z()) * TurnY(kAngles.y()) * TurnX(kAngles.x());
  EXPECT_TRUE(ReadRotation("roll_deg,pitch_deg,yaw_deg", ThreeDegrees(kAngles)).isApprox(R, 1e-14));
  EXPECT_TRUE(ReadRotation("roll_rad,pitch_rad,yaw_rad", "0.3,-0.7,2.1").isApprox(R, 1e-14));
}

TEST(RecordingOrientation, KukaAnglesTurnAboutZThenYThenX) {
  const Eigen::Matrix3d R = TurnZ(kAngles.x()) * TurnY(kAngles.y()) * TurnX(kAngles.z());
  EXPECT_TRUE(ReadRotation("a_deg,b_deg,c_deg", ThreeDegrees(kAngles)).isApprox(R, 1e-14));
  EXPECT_TRUE(ReadRotation("A [deg],B [deg],C [deg]", ThreeDegrees(kAngles)).isApprox(R, 1e-14));
}

TEST(RecordingOrientation, EulerXyzTurnsAboutTurningAxes) {
  const Eigen::Matrix3d R = TurnX(kAngles.x()) * TurnY(kAngles.y()) * TurnZ(kAngles.z());
  EXPECT_TRUE(ReadRotation("euler_xyz_x_deg,euler_xyz_y_deg,euler_xyz_z_deg", ThreeDegrees(kAngles))
                  .isApprox(R, 1e-14));
}

TEST(RecordingOrientation, RotationVectorIsAxisTimesAngle) {
  // Rodrigues' formula about the axis (2, -1, 2) / 3 by 1.5 rad.
  const Eigen::Vector3d axis = Eigen::Vector3d(2, -1, 2) / 3;
  Eigen::Matrix3d K;
  K << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const Eigen::Matrix3d R =
      Eigen::Matrix3d::Identity() + std::sin(1.5) * K + (1 - std::cos(1.5)) * K * K;
  EXPECT_TRUE(
      ReadRotation("rotvec_x_rad,rotvec_y_rad,rotvec_z_rad", "1,-0.5,1").isApprox(R, 1e-14));
  EXPECT_TRUE(ReadRotation("rotvec_x_deg,rotvec_y_deg,rotvec_z_deg",
                           ThreeDegrees(Eigen::Vector3d(1, -0.5, 1)))
                  .isApprox(R, 1e-14));
}

constexpr char kMatrixNames[] = "m11,m12,m13,m14_mm,m21,m22,m23,m24_mm,m31,m32,m33,m34_mm";

TEST(RecordingOrientation, MatrixIsReadRowByRowWithItsPosition) {
  const TempFile file(std::string("q1_deg,") + kMatrixNames +
                          ",m41,m42,m43,m44\n1,0,-1,0,100,1,0,0,200,0,0,1,300,0,0,0,1\n",
                      ".csv");
  Diagnostics diagnostics;
  const auto recording = ReadRecording(file.path(), JointsOf("R"), &diagnostics);
  ASSERT_TRUE(recording.has_value()) << diagnostics.ToString();
  EXPECT_EQ(diagnostics.ToString(), "");
  EXPECT_TRUE(recording->p_WQ.row(0).isApprox(Eigen::RowVector3d(0.1, 0.2, 0.3)));
  const Eigen::RowVector4d q = recording->quaternion.row(0);
  EXPECT_TRUE(Eigen::Quaterniond(q[0], q[1], q[2], q[3])
                  .toRotationMatrix()
                  .isApprox(TurnZ(kPi / 2), 1e-14));
}

TEST(RecordingOrientation, MatrixThatIsNoRotationIsRefused) {
  std::string messages;
  ReadRotation(kMatrixNames, "0,-1,0,1,1,0,0,2,0,0,1.1,3", &messages);
  EXPECT_THAT(messages,
              HasSubstr("2:3: error: column 'm11': the matrix m11 ... m33 is no rotation"));
  ReadRotation(kMatrixNames, "0,-1,0,1,1,0,0,2,0,0,-1,3", &messages);  // mirrored
  EXPECT_THAT(messages, HasSubstr("its determinant is -1"));
}

TEST(RecordingOrientation, MatrixWrittenByColumnsShowsInItsLastRow) {
  std::string messages;
  ReadRotation("m11,m12,m13,m14_mm,m21,m22,m23,m24_mm,m31,m32,m33,m34_mm,m41,m42,m43,m44",
               "1,0,0,0,0,1,0,0,0,0,1,0,100,200,300,1",
               &messages);
  EXPECT_THAT(messages, HasSubstr("column 'm41': 100 must be 0"));
  EXPECT_THAT(messages, HasSubstr("written column by column?"));
}

TEST(RecordingOrientation, TwoFormsAreRefused) {
  std::string messages;
  ReadRotation("roll_deg,pitch_deg,yaw_deg,qw,qx,qy,qz", "1,2,3,1,0,0,0", &messages);
  EXPECT_THAT(messages, HasSubstr("both give the orientation; keep one form"));
}

TEST(RecordingOrientation, PlainRotationNamesAreAskedAbout) {
  std::string messages;
  ReadRotation("rx_rad,ry_rad,rz_rad", "1,2,3", &messages);
  EXPECT_THAT(messages,
              HasSubstr("warning: 'rx_rad' to 'rz_rad' may be a rotation vector or angles"));
  EXPECT_THAT(
      messages,
      HasSubstr("columns: {rotvec_x_rad: rx_rad, rotvec_y_rad: ry_rad, rotvec_z_rad: rz_rad}"));
}

}  // namespace
}  // namespace dhcal
