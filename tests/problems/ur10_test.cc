// The real UR10 recordings, against an independent fit of the same series.

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/files.h"
#include "tests/support/problem_cases.h"

namespace dhcal {
namespace {

struct Published {
  const char* name;
  double frames_only, complete, complete_max;  // 3-D RMS, RMS and maximum [mm]
};

class Ur10 : public ::testing::TestWithParam<Published> {
 protected:
  void SetUp() override {
    if (DataDir().empty()) {
      GTEST_SKIP() << "set DHCAL_DATA to the folder that holds ipa_ur10/ to run this test";
    }
  }
};

TEST_P(Ur10, CompleteGeometryMatchesTheIndependentFit) {
  ProblemSpec spec = LoadCase(GetParam().name);
  // The independent fit kept every direction above rounding.
  spec.solver.rule = TruncationRule::kRelative;
  spec.solver.relative_tolerance = 1e-9;
  const Result result = RunCase(spec);
  ASSERT_NE(result.best(), nullptr);
  EXPECT_EQ(result.best()->rank, 27);
  EXPECT_NEAR(result.best()->rms_point * 1e3 / GetParam().complete, 1.0, 0.01);
  EXPECT_NEAR(result.best()->max_point * 1e3 / GetParam().complete_max, 1.0, 0.01);
}

TEST_P(Ur10, DefaultRuleFitsAsWellWithoutDirectionsThatOnlyTheMisfitDetermines) {
  const Result result = RunCase(LoadCase(GetParam().name));
  ASSERT_NE(result.best(), nullptr);
  EXPECT_TRUE(result.best()->converged);
  EXPECT_NEAR(result.base_and_tool_only->rms_point * 1e3 / GetParam().frames_only, 1.0, 0.01);
  EXPECT_NEAR(result.best()->rms_point * 1e3 / GetParam().complete, 1.0, 0.01);
  EXPECT_EQ(result.best()->rank, 25);
  EXPECT_EQ(result.best()->rank_numerical, 27);
  for (const ParameterResult& parameter : result.best()->parameters) {
    if (parameter.name.rfind("base", 0) == 0) continue;  // the tracker's place
    const double plausible = parameter.unit == Unit::kMetre ? 3e-3 : 5e-3;
    EXPECT_LT(std::abs(parameter.correction), plausible) << parameter.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Series,
                         Ur10,
                         ::testing::Values(Published{"ur10_ipa_a", 0.838, 0.439, 1.14},
                                           Published{"ur10_ipa_b", 1.085, 0.441, 2.02}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace dhcal
