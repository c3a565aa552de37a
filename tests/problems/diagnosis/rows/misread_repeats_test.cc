// One of several readings of a pose is wrong: the others show it.
#include "problems/diagnosis/rows/misread_repeats.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "residuals/registry.h"
#include "tests/support/problem_cases.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kPoses = 60;

/// Every pose of an arm read `times`, one after the other.
Recording ReadSeveralTimes(const TrueRobot& truth, const ProblemSpec& spec, int times) {
  RecordingPlan plan;
  plan.poses = kPoses;
  plan.sigma = 0;
  const Recording once = Record(truth, spec, plan);
  const Eigen::ArrayXi pose =
      Eigen::ArrayXi::LinSpaced(times * kPoses, 0, times * kPoses - 1) / times;
  Recording recording = once;
  recording.q = once.q(pose, Eigen::all);
  recording.p_WQ = once.p_WQ(pose, Eigen::all);
  Rng rng(17);
  for (double& value : recording.p_WQ.reshaped()) value += 20e-6 * rng.Normal();
  return recording;
}

class Repeats : public testing::TestWithParam<int> {
 protected:
  Repeats()
      : truth_(MakeTrueRobot(Kr15(), 7)),
        spec_(MakeSpec(truth_.nominal, KindNamed("position"), NoiseKind::kIndependent)),
        recording_(ReadSeveralTimes(truth_, spec_, GetParam())) {}
  std::vector<int> Misread() const {
    return MisreadRepeats(recording_, PutRepeatsTogether(recording_, Eigen::MatrixXd::Zero(0, 0)));
  }
  TrueRobot truth_;
  ProblemSpec spec_;
  Recording recording_;
};

TEST_P(Repeats, OutvoteTheOneThatIsWrong) {
  EXPECT_THAT(Misread(), IsEmpty());
  recording_.p_WQ(50, 1) += 5e-3;
  recording_.p_WQ(101, 2) -= 0.4e-3;
  EXPECT_THAT(Misread(), ElementsAre(50, 101));
}

TEST_P(Repeats, AreFittedWithoutIt) {
  recording_.p_WQ(50, 1) += 5e-3;
  const DiagnosisResult d = Diagnosed(spec_, recording_);
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kConsistent) << d.summary;
  EXPECT_THAT(d.misfit.outlier_rows, ElementsAre(50));
}

INSTANTIATE_TEST_SUITE_P(Times, Repeats, testing::Values(3, 4, 7));

}  // namespace
}  // namespace dhcal
