#include "problems/setup/doctor.h"

#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "problems/setup/frames_alone.h"
#include "residuals/registry.h"
#include "tests/support/sanitized.h"
#include "tests/support/set_up_files.h"

namespace dhcal {
namespace {

using testing::ElementsAre;

constexpr char kTooSlow[] = "too slow with sanitizers; the other tests run the same code";
constexpr double kFineNoise = 30e-6;  // [m]

/// Files that were right, and what is done to them.
struct Mistake {
  std::string name;
  std::string kind;
  std::vector<int> joints;
  std::function<void(ProblemSpec*, Recording*)> make;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

std::vector<Mistake> Mistakes() {
  return {
      {"sense",
       "joint_sense",
       {2, 5},
       [](ProblemSpec*, Recording* r) {
         r->q.col(1) *= -1;
         r->q.col(4) *= -1;
       }},
      {"order",
       "joint_order",
       {2, 3},
       [](ProblemSpec*, Recording* r) { r->q.col(1).swap(r->q.col(2)); }},
      {"zero",
       "zero_offset",
       {3},
       [](ProblemSpec*, Recording* r) { r->q.col(2).array() -= kPi / 2; }},
      {"convention",
       "convention",
       {},
       [](ProblemSpec* spec, Recording*) { spec->robot.convention = DhConvention::kModified; }},
      {"coupling",
       "coupling",
       {3, 2},
       [](ProblemSpec*, Recording* r) { r->q.col(2) -= r->q.col(1); }},
      {"radians_read_as_degrees",
       "unit",
       {1, 2, 3, 4, 5, 6},
       [](ProblemSpec*, Recording* r) { r->q *= kDegree; }},
      {"wrist_in_radians",
       "unit",
       {4, 5, 6},
       [](ProblemSpec*, Recording* r) { r->q.rightCols<3>() *= kDegree; }},
      {"twists_in_radians",
       "unit",
       {},
       [](ProblemSpec* spec, Recording*) {
         for (JointRow& row : spec->robot.joints) {
           row.alpha *= kDegree;
           row.theta *= kDegree;
         }
       }},
      {"lengths_in_millimetres",
       "unit",
       {},
       [](ProblemSpec* spec, Recording*) {
         for (JointRow& row : spec->robot.joints) {
           row.a *= 1000;
           row.d *= 1000;
         }
       }},
      {"tool_in_millimetres",
       "unit",
       {},
       [](ProblemSpec* spec, Recording*) {
         spec->robot.X_TQ.translation() = Eigen::Vector3d(30, -50, 120);
       }},
      {"readings_in_inches", "unit", {}, [](ProblemSpec*, Recording* r) { r->p_WQ /= 25.4; }},
      {"mirrored", "mirrored_frame", {}, [](ProblemSpec*, Recording* r) { r->p_WQ.col(0) *= -1; }},
      {"reading_lost",
       "row_shift",
       {},
       [](ProblemSpec*, Recording* r) {
         for (int row = 30; row + 1 < r->num_rows(); ++row) r->p_WQ.row(row) = r->p_WQ.row(row + 1);
       }},
  };
}

class Doctor : public testing::TestWithParam<Mistake> {};

TEST_P(Doctor, NamesTheOneThingThatIsWrong) {
  const bool quick = GetParam().kind == "joint_sense" || GetParam().kind == "coupling" ||
                     GetParam().kind == "mirrored_frame";
  if (kSanitized && !quick) GTEST_SKIP() << kTooSlow;
  Rng rng(3);
  ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
  Recording recording = RecordingOfRobot(spec.robot, 70, kFineNoise, &rng);
  const double right = FitFrames(spec, recording).rms;
  GetParam().make(&spec, &recording);
  const double before = FitFrames(spec, recording).rms;
  EXPECT_GT(before, 10 * right);

  const Findings findings = FindCauses({spec, recording}, before, 100);
  ASSERT_EQ(findings.causes.size(), 1U);
  const SetupCause& cause = findings.causes[0];
  EXPECT_EQ(cause.kind, GetParam().kind) << cause.sentence;
  EXPECT_EQ(cause.joints, GetParam().joints) << cause.sentence;
  EXPECT_FALSE(cause.text.empty());
  // With the cure the files fit as they did before.
  ASSERT_TRUE(findings.cured.has_value());
  const double cured = FitFrames(findings.cured->spec, findings.cured->recording).rms;
  EXPECT_LT(cured, 1.2 * right);
  EXPECT_NEAR(cause.rms_after, cured, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, Doctor, testing::ValuesIn(Mistakes()), [](const auto& param) {
  return param.param.name;
});

TEST(DoctorOfRightFiles, FindsNothing) {
  Rng rng(4);
  const ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
  const Recording recording = RecordingOfRobot(spec.robot, 70, kFineNoise, &rng);
  EXPECT_TRUE(FindCauses({spec, recording}, FitFrames(spec, recording).rms, 100).causes.empty());
}

TEST(DoctorOfAnotherRobot, ClaimsNothing) {
  if (kSanitized) GTEST_SKIP() << kTooSlow;
  Rng rng(5);
  ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
  const Recording recording = RecordingOfRobot(spec.robot, 70, kFineNoise, &rng);
  spec.robot.joints[1].a *= 0.7;
  spec.robot.joints[3].d *= 1.4;
  const double before = FitFrames(spec, recording).rms;
  EXPECT_TRUE(FindCauses({spec, recording}, before, 100).causes.empty());
}

TEST(FindMovedFrames, NamesTheFrameThatMoved) {
  Rng rng(6);
  const ProblemSpec spec = ProblemOf(Kr15(), KindNamed("position"));
  Recording recording = RecordingOfRobot(spec.robot, 80, kFineNoise, &rng);
  recording.run_names = {"mon", "tue"};
  for (int row = 0; row < 80; ++row) recording.run_idx.push_back(row / 40);
  recording.p_WQ.bottomRows(40).col(1).array() += 0.08;
  const Findings findings = FindMovedFrames({spec, recording}, FitFrames(spec, recording).rms);
  ASSERT_FALSE(findings.causes.empty());
  EXPECT_EQ(findings.causes[0].kind, "frame_per_run");
  EXPECT_EQ(findings.causes[0].text, "base: {per_run: true}");
}

OrientationFindings FormOf(const ProblemSpec& spec, const Recording& recording) {
  return FindOrientationForm({spec, recording}, FitFrames(spec, recording));
}

TEST(FindOrientationForm, NamesOrderAndInverse) {
  Rng rng(8);
  const ProblemSpec spec = ProblemOf(Kr15(), KindNamed("pose"));
  const Recording right = RecordingOfRobot(spec.robot, 40, kFineNoise, &rng);
  EXPECT_LT(FormOf(spec, right).misfit, 0.01);
  EXPECT_TRUE(FormOf(spec, right).findings.causes.empty());

  Recording scalar_last = right;
  scalar_last.quaternion.leftCols<3>() = right.quaternion.rightCols<3>();
  scalar_last.quaternion.col(3) = right.quaternion.col(0);
  const OrientationFindings order = FormOf(spec, scalar_last);
  EXPECT_GT(order.misfit, 0.5);
  ASSERT_EQ(order.findings.causes.size(), 1U);
  EXPECT_THAT(order.findings.causes[0].text, testing::HasSubstr("qx, qy, qz, qw"));
  ASSERT_TRUE(order.findings.cured.has_value());
  EXPECT_TRUE(order.findings.cured->recording.quaternion.isApprox(right.quaternion));

  // A lost orientation says nothing of the others.
  scalar_last.quaternion.row(3).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(FormOf(spec, scalar_last).findings.causes.size(), 1U);

  Recording inverse = right;
  inverse.quaternion.rightCols<3>() *= -1;
  const OrientationFindings turned = FormOf(spec, inverse);
  ASSERT_EQ(turned.findings.causes.size(), 1U);
  EXPECT_THAT(turned.findings.causes[0].sentence, testing::HasSubstr("seen from the tool"));
}

}  // namespace
}  // namespace dhcal
