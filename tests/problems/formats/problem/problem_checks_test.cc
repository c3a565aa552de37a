// What fits; what does not is in broken_input_test.cc.
#include "problems/formats/problem/problem_checks.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/temp_file.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

/// Every message about a recording for one of the good problems.
std::string Messages(const std::string& problem, const std::string& recording_text) {
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(
      std::string(DHCAL_SOURCE_DIR "/tests/data/good/") + problem, "", &diagnostics);
  EXPECT_TRUE(spec.has_value()) << diagnostics.ToString();
  const TempFile file(recording_text, ".csv");
  const auto recording = ReadRecording(file.path(), spec->robot.joints, &diagnostics);
  EXPECT_TRUE(recording.has_value()) << diagnostics.ToString();
  CheckRecordingFits(*spec, *recording, &diagnostics);
  return diagnostics.ToString();
}

TEST(ProblemChecks, PositionsFit) {
  EXPECT_EQ(Messages("position.yaml", "q1_deg,q2_deg,x_mm,y_mm,z_mm\n1,2,3,4,5\n"), "");
}

TEST(ProblemChecks, AdjacentPositionsFitAsPositionsOrAsDisplacements) {
  EXPECT_EQ(Messages("adjacent_position.yaml", "q1_deg,q2_deg,x_mm,y_mm,z_mm\n1,2,3,4,5\n"), "");
  EXPECT_EQ(Messages("adjacent_position.yaml", "q1_deg,q2_deg,dx_mm,dy_mm,dz_mm\n1,2,3,4,5\n"), "");
}

TEST(ProblemChecks, PosesFit) {
  EXPECT_EQ(Messages("pose.yaml", "q1_deg,q2_deg,x_mm,y_mm,z_mm,qw,qx,qy,qz\n1,2,3,4,5,1,0,0,0\n"),
            "");
}

TEST(ProblemChecks, DistancesFit) {
  EXPECT_EQ(Messages("distance.yaml",
                     "q1_deg,q2_deg,distance_mm,anchor\n1,2,500,west\n1,2,500,east\n1,2,,\n"),
            "");
}

TEST(ProblemChecks, UnusedAnchorIsAWarning) {
  EXPECT_THAT(Messages("distance.yaml", "q1_deg,q2_deg,distance_mm,anchor\n1,2,500,west\n"),
              HasSubstr("warning: no row has the anchor 'east' of the problem file"));
}

TEST(ProblemChecks, UnusedTargetIsAWarning) {
  EXPECT_THAT(Messages("targets.yaml", "q1_deg,q2_deg,x_mm,y_mm,z_mm,target\n1,2,3,4,5,A\n"),
              HasSubstr("warning: no row has the target 'B' of the problem file"));
}

TEST(ProblemChecks, OneTargetForTheToolIsAWarning) {
  EXPECT_THAT(Messages("position.yaml", "q1_deg,q2_deg,x_mm,y_mm,z_mm,target\n1,2,3,4,5,A\n"),
              HasSubstr("warning: every row measured the target 'A'"));
}

TEST(ProblemChecks, NamedRunsThatAreThereFit) {
  EXPECT_EQ(Messages("runs.yaml",
                     "q1_deg,q2_deg,x_mm,y_mm,z_mm,run\n1,2,3,4,5,morning\n1,2,3,4,5,evening\n"),
            "");
}

}  // namespace
}  // namespace dhcal
