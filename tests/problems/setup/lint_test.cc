#include "problems/setup/lint.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "residuals/registry.h"
#include "tests/support/set_up_files.h"

namespace dhcal {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class LintOf : public testing::Test {
 protected:
  Rng rng{1};
  ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
  Recording recording = RecordingOfRobot(spec.robot, 30, 30e-6, &rng);
};

TEST_F(LintOf, AnOrdinaryRecordingIsNothing) { EXPECT_THAT(Lint(spec, recording), IsEmpty()); }

TEST_F(LintOf, JointsThatStandStillOrMoveLittleNamesThem) {
  recording.q.col(5).setConstant(0.3);
  recording.q.col(3) *= 0.01;
  EXPECT_THAT(Lint(spec, recording),
              ElementsAre(HasSubstr("Joint 6 stands still"), HasSubstr("Joint 4 moves over")));
}

TEST_F(LintOf, RepeatedPosesCountsThem) {
  for (int row = 10; row < 30; ++row) recording.q.row(row) = recording.q.row(row % 10);
  EXPECT_THAT(Lint(spec, recording), ElementsAre(HasSubstr("30 rows are of 10 distinct poses")));
}

TEST_F(LintOf, ImpossibleTimesSaysWhichAndWhy) {
  recording.time = Eigen::VectorXd::LinSpaced(30, 0, 2e9);
  EXPECT_THAT(Lint(spec, recording), ElementsAre(HasSubstr("spans 63 years")));
  recording.time = Eigen::VectorXd::LinSpaced(30, 0, 300);
  recording.time[7] = 0;
  EXPECT_THAT(Lint(spec, recording), ElementsAre(HasSubstr("runs backwards once")));
}

TEST_F(LintOf, TwistsThatLookLikeRadiansAsksForThem) {
  spec.robot.joints[0].alpha = 1.5708 * kDegree;
  EXPECT_THAT(Lint(spec, recording), ElementsAre(HasSubstr("write alpha_rad")));
}

TEST_F(LintOf, GravityAlongATiltedBaseAsksForIt) {
  spec.robot.links.resize(6);
  spec.robot.X_WB = Eigen::Isometry3d::Identity();
  EXPECT_THAT(Lint(spec, recording), IsEmpty());
  spec.robot.X_WB = MakeFrame({0, 0, 1}, {kPi / 2, 0, 0});
  EXPECT_THAT(Lint(spec, recording), ElementsAre(HasSubstr("tilted by 90.0 deg")));
}

TEST_F(LintOf, GravityOfARobotOnTheCeilingIsStatedWell) {
  spec.robot.links.resize(6);
  spec.robot.X_WB = MakeFrame({0, 0, 3}, {kPi, 0, 0});
  EXPECT_THAT(Lint(spec, recording), ElementsAre(HasSubstr("tilted by 180.0 deg")));
  spec.robot.gravity_B = {0, 0, 9.80665};
  EXPECT_THAT(Lint(spec, recording), IsEmpty());
}

}  // namespace
}  // namespace dhcal
