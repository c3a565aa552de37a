// Recordings from MATLAB.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/robots.h"
#include "tests/support/temp_mat.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

TEST(RecordingMat, MatricesAreJointsPositionAndOrientation) {
  std::vector<double> q = {10, 20, 30, 40, 50, 60};              // 3 rows, 2 joints
  std::vector<double> p = {1, 2, 3, 4, 5, 6, 7, 8, 9};           // x, y, z
  std::vector<double> r = {0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0};  // w, x, y, z
  std::vector<double> t = {0, 1, 2};
  const TempMat file({MatVariable("q_deg", 3, 2, q.data()),
                      MatVariable("xyz_mm", 3, 3, p.data()),
                      MatVariable("quat", 3, 4, r.data()),
                      MatVariable("t_s", 3, 1, t.data())},
                     false);
  Diagnostics diagnostics;
  const auto recording = ReadRecording(file.path(), JointsOf("RR"), &diagnostics);
  ASSERT_TRUE(recording.has_value()) << diagnostics.ToString();
  ASSERT_EQ(recording->num_rows(), 3);
  EXPECT_TRUE(recording->q.row(1).isApprox(Eigen::RowVector2d(20, 50) * kDegree));
  EXPECT_TRUE(recording->p_WQ.row(2).isApprox(Eigen::RowVector3d(3, 6, 9) * kMillimetre));
  EXPECT_EQ(recording->quaternion.row(0), Eigen::RowVector4d(0, 1, 0, 0));
  EXPECT_EQ(recording->time[2], 2);
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("qw = 'quat(1)'"));
}

TEST(RecordingMat, PlacesAreThoseOfTheTableAsText) {
  std::vector<double> q = {10, 20, 30}, sigma = {1, -1, 1};
  const TempMat file(
      {MatVariable("q1_deg", 3, 1, q.data()), MatVariable("sigma_mm", 3, 1, sigma.data())}, true);
  Diagnostics diagnostics;
  EXPECT_FALSE(ReadRecording(file.path(), JointsOf("R"), &diagnostics).has_value());
  EXPECT_THAT(diagnostics.ToString(), HasSubstr(".mat:3:4: error: column 'sigma_mm': -1 must be"));
}

}  // namespace
}  // namespace dhcal
