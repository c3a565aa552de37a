#include "tools/support/acceptance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "residuals/registry.h"
#include "tests/support/example_result.h"

namespace dhcal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Result PositionsWithUnseenError(double metres) {
  Result result = ExampleResult();
  result.kind = KindNamed("position");
  result.delivered.reset();
  result.validation.method = "set column";
  result.validation.rms_test = 1;  // per coordinate: not what is announced of points
  result.validation.rms_point_test = metres;
  return result;
}

TEST(Acceptance, LengthsNeedAUnitAndAreAboveZero) {
  EXPECT_DOUBLE_EQ(ParseLimit("0.1mm").value(), 1e-4);
  EXPECT_DOUBLE_EQ(ParseLimit("100um").value(), 1e-4);
  EXPECT_DOUBLE_EQ(ParseLimit("0.25 mm").value(), 2.5e-4);
  for (const char* const bad : {"", "mm", "0.1", "0mm", "-1mm", "0,1mm", "1m", "1 in", "nanmm"}) {
    EXPECT_FALSE(ParseLimit(bad).has_value()) << bad;
  }
}

TEST(Acceptance, TheErrorOfPointsOnUnseenRowsDecides) {
  const Result result = PositionsWithUnseenError(0.00012);
  const Acceptance met = JudgeAcceptance(result, 0.00012);
  EXPECT_TRUE(met.met);
  EXPECT_THAT(met.sentence, HasSubstr("within the 0.1200 mm asked for"));
  const Acceptance missed = JudgeAcceptance(result, 0.0001);
  EXPECT_FALSE(missed.met);
  EXPECT_THAT(missed.sentence,
              AllOf(HasSubstr("not accepted"),
                    HasSubstr("errs by 0.1200 mm (RMS, 3-D), more than the 0.1000 mm asked for"),
                    Not(HasSubstr("excluded"))));
}

TEST(Acceptance, TheModelThatIsDeliveredIsJudged) {
  Result result = PositionsWithUnseenError(0.005);
  result.delivered.emplace();
  result.delivered->validation.rms_test = 5e-5;
  result.delivered->validation.rms_point_test = 8e-5;
  EXPECT_TRUE(JudgeAcceptance(result, 1e-4).met);
}

TEST(Acceptance, NothingIsAcceptedThatNoUnseenRowShows) {
  Result result = PositionsWithUnseenError(kNotSet);
  result.validation = {};
  const Acceptance acceptance = JudgeAcceptance(result, 1e9);
  EXPECT_FALSE(acceptance.met);
  EXPECT_THAT(acceptance.sentence,
              AllOf(HasSubstr("no row was kept unseen"), HasSubstr("write test in a column set")));
}

TEST(Acceptance, UnseenRowsThatWereExcludedAreTold) {
  Result result = PositionsWithUnseenError(1e-5);
  result.rows_set_aside = {{3, true, "far off", 0.01}, {4, false, "far off", 0.01}};
  EXPECT_THAT(JudgeAcceptance(result, 1e-4).sentence, HasSubstr("(1 of these rows excluded"));
}

}  // namespace
}  // namespace dhcal
