// Each row states its own noise: what the report says in millimetres is of the readings all the
// same.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "residuals/registry.h"
#include "tests/support/problem_cases.h"
#include "tests/support/recorder.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

/// Readings without noise get noise of a size that each row states: 10 to 40 um.
double AddStatedNoise(std::uint64_t seed, Recording* recording) {
  Rng rng(seed);
  recording->sigma.resize(recording->num_rows());
  double squares = 0;
  for (int row = 0; row < recording->num_rows(); ++row) {
    recording->sigma[row] = 1e-5 * std::pow(4.0, rng.Uniform(0, 1));
    for (int k = 0; k < 3; ++k) {
      recording->p_WQ(row, k) += recording->sigma[row] * rng.Normal();
    }
    squares += recording->sigma[row] * recording->sigma[row];
  }
  return std::sqrt(squares / recording->num_rows());
}

class RowsOfOwnNoise : public testing::TestWithParam<std::string> {};

TEST_P(RowsOfOwnNoise, AreCountedInMetres) {
  const TrueRobot truth = MakeTrueRobot(Kr15(), 5);
  const bool pairs = GetParam() != "position";
  const ProblemSpec spec = MakeSpec(truth.nominal,
                                    KindNamed(GetParam()),
                                    pairs ? NoiseKind::kSharedPose : NoiseKind::kIndependent);
  RecordingPlan plan;
  plan.sigma = 0;
  Recording recording = Record(truth, spec, plan);
  const double sigma = AddStatedNoise(6, &recording);
  for (const bool test_rows : {false, true}) {
    SCOPED_TRACE(test_rows);
    if (test_rows) {
      recording.is_test.assign(static_cast<std::size_t>(recording.num_rows()), false);
      for (std::size_t row = 120; row < recording.is_test.size(); ++row) {
        recording.is_test[row] = true;
      }
    }
    const DiagnosisResult d = Diagnosed(spec, recording);
    EXPECT_EQ(d.verdict, DiagnosisVerdict::kConsistent);
    EXPECT_GT(d.misfit.rms, 0.7 * sigma);
    EXPECT_LT(d.misfit.rms, 1.2 * sigma);
    EXPECT_GT(d.rms_test_after, 0.8 * sigma);
    EXPECT_LT(d.rms_test_after, 1.5 * sigma);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         RowsOfOwnNoise,
                         testing::Values("position", "adjacent_position"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace dhcal
