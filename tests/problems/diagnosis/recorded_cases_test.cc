// Recordings made by another author's simulation, on which a single pass of the diagnosis went
// wrong. Each case's own text says what is right.
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "problems/diagnosis/diagnose.h"
#include "tests/support/files.h"
#include "tests/support/problem_cases.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

class RecordedCase : public testing::Test {
 protected:
  void SetUp() override {
    if (SharedDir().empty()) {
      GTEST_SKIP() << "set DHCAL_SHARED to the folder that holds cases/ to run this test";
    }
  }
  static ProblemSpec Spec(const std::string& name) {
    return LoadProblem(SharedDir() + "/cases/" + name + "/problem.yaml");
  }
  static DiagnosisResult Diagnosis(const std::string& name) {
    const ProblemSpec spec = Spec(name);
    return Diagnosed(spec, RecordingOf(spec));
  }
};

std::vector<std::string> NamesOf(const DiagnosisResult& d) {
  std::vector<std::string> names;
  for (const Finding& finding : d.findings) names.push_back(finding.effect.effect);
  return names;
}

TEST_F(RecordedCase, StrongSagAsksForNoFrameAndSetsNoRowAside) {
  const DiagnosisResult d = Diagnosis("strong_sag");
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kExplained) << d.summary;
  ASSERT_THAT(NamesOf(d), ElementsAre("joint_compliance")) << d.summary;
  EXPECT_EQ(d.findings[0].effect.joint, 2);
  const FoundParameter& c = d.findings[0].parameters[0];
  EXPECT_NEAR(c.value, 50e-6, 4 * c.sigma);
  EXPECT_THAT(d.misfit.outlier_rows, IsEmpty());
}

TEST_F(RecordedCase, ADriftOfTheInstrumentIsNoShiftOfTheBaseAsWell) {
  const DiagnosisResult d = Diagnosis("drift_of_the_base");
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kExplained) << d.summary;
  EXPECT_THAT(NamesOf(d), ElementsAre("base_drift")) << d.summary;
}

TEST_F(RecordedCase, MisreadTestRowsAreNamedAndDoNotOutvoteThePlay) {
  const DiagnosisResult d = Diagnosis("play_and_outliers");
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kExplained) << d.summary;
  ASSERT_THAT(NamesOf(d), ElementsAre("backlash")) << d.summary;
  EXPECT_EQ(d.findings[0].effect.joint, 4);
  const FoundParameter& width = d.findings[0].parameters[0];
  EXPECT_NEAR(width.value, 0.35e-3, 4 * width.sigma);
  // Counted from 0; 92 and 308 are test rows.
  EXPECT_THAT(d.misfit.outlier_rows, ElementsAre(64, 65, 92, 214, 241, 251, 308));
  EXPECT_EQ(d.misfit.outliers, 7);
  const double sigma = Spec("play_and_outliers").measurement.sigma.value();
  EXPECT_LT(d.rms_test_after, 1.2 * sigma);
  EXPECT_GT(d.rms_test_before, d.rms_test_after);
}

TEST_F(RecordedCase, ParkedJointsWithThreePayloadsGiveAnAnswerAndDriveNothing) {
  const DiagnosisResult d = Diagnosis("parked_joints_three_payloads");
  EXPECT_NE(d.verdict, DiagnosisVerdict::kFailed) << d.summary;
  const std::set<std::string> parked = {"q3", "q4", "q5", "q6", "q7"};
  for (const MapEntry& entry : d.map) EXPECT_EQ(parked.count(entry.driver), 0) << entry.slot;
  EXPECT_THAT(NamesOf(d), Contains("tool_per_run")) << d.summary;
  EXPECT_THAT(NamesOf(d), Contains("joint_compliance")) << d.summary;
}

}  // namespace
}  // namespace dhcal
