// Two results side by side: what the comparison reads, computes and says.

#include <cmath>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/diagnostics.h"
#include "core/report/html/html_renderer.h"
#include "core/report/text_renderer.h"
#include "problems/formats/result/result_writer.h"
#include "tests/support/example_result.h"
#include "tests/support/temp_folder.h"
#include "tools/compare/comparison_report.h"
#include "tools/compare/moved.h"

namespace dhcal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

ReadResult Plain(double unseen, int rows) {
  ReadResult result;
  result.folder = "somewhere";
  result.problem = "cell";
  result.kind = "position";
  result.in_space = result.intervals_hold = true;
  result.unseen = unseen;
  result.unseen_rows = rows;
  result.unseen_method = "set column";
  result.parameters = {{"theta2", "rad", 0.001, 3e-5, true},
                       {"d1", "m", 0.5, 0.1, false},
                       {"joint_compliance.2.compliance", "rad/(N m)", 3e-6, 3e-8, true}};
  return result;
}

TEST(Compare, ADifferenceCountsInSigmasOfBoth) {
  const ReadResult a = Plain(1e-4, 100);
  ReadResult b = a;
  b.parameters[0].value = 0.001 + 5e-4;
  b.parameters[0].sigma = 4e-5;  // with 3e-5 makes 5e-5: ten sigmas
  b.parameters[1].value = 0.9;
  b.parameters.pop_back();
  const Moved moved = MovedBetween(a, b);
  ASSERT_EQ(moved.determined.size(), 1u);
  EXPECT_NEAR(moved.determined[0].sigmas(), 10.0, 1e-9);
  EXPECT_THAT(moved.open, ::testing::ElementsAre("d1"));
  EXPECT_THAT(moved.only_a, ::testing::ElementsAre("joint_compliance.2.compliance"));
  const std::string text = ToText(ComparisonReport(a, b));
  EXPECT_THAT(text, HasSubstr("1 of 1 parameters that both determine differs by more than 3"));
  EXPECT_THAT(text, AllOf(HasSubstr("mrad"), HasSubstr("10.0"), HasSubstr("Estimated in A only")));
}

TEST(Compare, BetterIsWhatChanceDoesNotMake) {
  // 300 numbers each: an RMS is known to 4.1 %, the ratio of two to 5.8 %.
  const ReadResult a = Plain(1e-4, 100);
  EXPECT_EQ(BetterOnUnseenRows(a, Plain(1.10e-4, 100)), Better::kAlike);
  EXPECT_EQ(BetterOnUnseenRows(a, Plain(1.14e-4, 100)), Better::kA);
  EXPECT_EQ(BetterOnUnseenRows(a, Plain(0.85e-4, 100)), Better::kB);
  EXPECT_EQ(BetterOnUnseenRows(a, Plain(0.85e-4, 3)), Better::kAlike);
  EXPECT_EQ(BetterOnUnseenRows(a, Plain(kNotSet, 0)), Better::kNotKnown);
}

TEST(Compare, APageSaysWhatTheTextSays) {
  const ReadResult a = Plain(1e-4, 100);
  const std::string page = ToHtml(ComparisonReport(a, Plain(5e-5, 100)));
  EXPECT_THAT(page,
              AllOf(HasSubstr("B predicts rows better that were not fitted"),
                    HasSubstr("joint_compliance.2.compliance"),
                    HasSubstr("urad/(N m)"),
                    Not(HasSubstr("<script"))));
}

TEST(Compare, ReadsTheFolderThatTheProgramWrites) {
  const TempFolder folder;
  const Result result = ExampleResult();
  WriteFile(folder / "result.json", ResultToJson(result));
  Diagnostics diagnostics;
  const std::optional<ReadResult> read = ReadResultFolder(folder.path().string(), &diagnostics);
  ASSERT_TRUE(read.has_value()) << diagnostics.ToString();
  EXPECT_EQ(read->problem, result.problem);
  EXPECT_EQ(read->rows, result.rows);
  EXPECT_DOUBLE_EQ(read->unseen, result.validation.rms_point_test);
  EXPECT_DOUBLE_EQ(read->before, result.base_and_tool_only->rms_point);
  EXPECT_DOUBLE_EQ(read->noise, std::sqrt(3.0) * result.noise_sigma);
  EXPECT_FALSE(MovedBetween(*read, *read).determined.empty());
}

TEST(Compare, RefusesWhatIsNoResult) {
  const TempFolder folder;
  for (const char* const text : {"{", "{\"schema\": 1}", "[]", "{\"best_fit\": 0}"}) {
    WriteFile(folder / "result.json", text);
    Diagnostics diagnostics;
    EXPECT_FALSE(ReadResultFolder(folder.path().string(), &diagnostics).has_value()) << text;
    EXPECT_THAT(diagnostics.ToString(), HasSubstr("result.json")) << text;
  }
  Diagnostics diagnostics;
  EXPECT_FALSE(ReadResultFolder(folder / "none", &diagnostics).has_value());
  EXPECT_FALSE(diagnostics.ok());
}

}  // namespace
}  // namespace dhcal
