// Calibrations judged in task space: readings and truth from the independent kinematics, the answer
// by its predictions at new poses.

#include <cmath>

#include <gtest/gtest.h>

#include "problems/identify.h"
#include "residuals/registry.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

struct Kind {
  const char* name;
  MeasurementKind kind;
  NoiseKind noise;
  int poses;
  bool base_is_near;  // no alignment for distances: the base must be known roughly
};

constexpr double kNoise = 20e-6;  // [m]

class Recovery : public ::testing::TestWithParam<Kind> {
 protected:
  static TrueRobot Truth(const RobotModel& nominal, std::uint64_t seed) {
    TrueRobot truth = MakeTrueRobot(nominal, seed);
    if (GetParam().base_is_near) {
      truth.X_VW = MakeFrame({3e-3, -2e-3, 1e-3}, {1e-3, 2e-3, -2e-3});
      truth.delta.tail<3>().setZero();
    }
    return truth;
  }
  static ProblemSpec Spec(const RobotModel& nominal) {
    return MakeSpec(nominal, GetParam().kind, GetParam().noise);
  }
  static RecordingPlan Plan(std::uint64_t seed) {
    RecordingPlan plan;
    plan.poses = GetParam().poses;
    plan.sigma = kNoise;
    plan.seed = seed;
    return plan;
  }
};

TEST_P(Recovery, PredictsNewPosesOfEveryRobotWithinTheNoise) {
  for (const RobotModel& nominal : {Ur10(), Kr15(), Kr15Modified(), Panda(), Scara()}) {
    const TrueRobot truth = Truth(nominal, 5);
    const ProblemSpec spec = Spec(nominal);
    const Recording recording = Record(truth, spec, Plan(11));
    const Result result = IdentifyGeometry(spec, recording, Progress());
    ASSERT_NE(result.best(), nullptr) << nominal.name;
    EXPECT_TRUE(result.best()->converged) << nominal.name << ": " << result.best()->message;
    EXPECT_NEAR(result.noise_sigma / kNoise, 1.0, 0.15) << nominal.name;
    // 27 or so directions from hundreds of readings: the prediction is sharper than one reading.
    EXPECT_LT(PredictionError(truth, spec, result.calibrated, 99), std::sqrt(3.0) * kNoise)
        << nominal.name;
  }
}

TEST_P(Recovery, ExactReadingsGiveExactPredictions) {
  const TrueRobot truth = Truth(Ur10(), 6);
  const ProblemSpec spec = Spec(Ur10());
  RecordingPlan plan = Plan(12);
  plan.sigma = plan.sigma_rotation = 0;
  const Result result = IdentifyGeometry(spec, Record(truth, spec, plan), Progress());
  ASSERT_NE(result.best(), nullptr);
  EXPECT_LT(PredictionError(truth, spec, result.calibrated, 99), 1e-8);
}

TEST_P(Recovery, BothSolversPredictAlike) {
  const TrueRobot truth = Truth(Kr15(), 7);
  ProblemSpec spec = Spec(Kr15());
  spec.solver.method = SolverMethod::kBoth;
  const Result result = IdentifyGeometry(spec, Record(truth, spec, Plan(13)), Progress());
  ASSERT_EQ(result.fits.size(), 2u);
  ASSERT_TRUE(result.fits[1].usable) << result.fits[1].message;
  EXPECT_NEAR(result.fits[0].rms / result.fits[1].rms, 1.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds,
    Recovery,
    ::testing::Values(
        Kind{"position", KindNamed("position"), NoiseKind::kIndependent, 150, false},
        Kind{"pose", KindNamed("pose"), NoiseKind::kIndependent, 150, false},
        Kind{"adjacent", KindNamed("adjacent_position"), NoiseKind::kIndependent, 150, false},
        Kind{"shared", KindNamed("adjacent_position"), NoiseKind::kSharedPose, 150, false},
        Kind{"distance", KindNamed("distance"), NoiseKind::kIndependent, 600, true}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Identify, GeometricRankIsTheKnownNumber) {
  // Complete model: 30 - 3 = 27 directions for positions, 24 for differences, 30 for poses.
  const struct {
    MeasurementKind kind;
    int rank;
  } cases[] = {
      {KindNamed("position"), 27}, {KindNamed("adjacent_position"), 24}, {KindNamed("pose"), 30}};
  for (const auto& expected : cases) {
    for (const RobotModel& nominal : {Kr15(), Ur10(), Kr15Modified()}) {
      const TrueRobot truth = MakeTrueRobot(nominal, 8);
      const ProblemSpec spec = MakeSpec(nominal, expected.kind, NoiseKind::kIndependent);
      const Result result =
          IdentifyGeometry(spec, Record(truth, spec, RecordingPlan()), Progress());
      EXPECT_EQ(result.best()->rank_numerical, expected.rank) << nominal.name;
    }
  }
}

}  // namespace
}  // namespace dhcal
