#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/first_screen.h"
#include "core/report/sections.h"
#include "core/report/text_renderer.h"
#include "tests/support/example_result.h"

namespace dhcal {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Result WithTask() {
  Result result = ExampleResult();
  TaskError& task = result.task.emplace();
  task.region = "300 random poses in the box somewhere";
  task.poses = 300;
  task.before = {2.5e-3, 2.4e-3, 2.6e-3};
  task.after = {31e-6, 22e-6, 41e-6};
  task.after_largest = 77e-6;
  task.hidden = 0.12e-3;
  return result;
}

TEST(TaskSection, TellsErrorsBeforeAndAfterAndWhatStaysHidden) {
  const Result result = WithTask();
  for (const std::string& text :
       {ToText(TaskSection(result)), ToText(FirstScreenOf(result, "out"))}) {
    EXPECT_THAT(text,
                AllOf(HasSubstr("300 random poses"),
                      HasSubstr("2.500"),
                      HasSubstr("0.0310"),
                      HasSubstr("0.0220"),
                      HasSubstr("0.1200")));
  }
  EXPECT_THAT(ToText(TaskSection(result)), HasSubstr("0.0770"));
}

TEST(TaskSection, SaysWhyThereAreNoFigures) {
  Result result = WithTask();
  result.task->unknown = "The robot does not get there";
  EXPECT_THAT(ToText(FirstScreenOf(result, "out")), HasSubstr("The robot does not get there."));
  EXPECT_THAT(ToText(TaskSection(result)),
              AllOf(HasSubstr("The robot does not get there."), Not(HasSubstr("2.500"))));
}

TEST(TaskSection, NamesWhatIsNotInItsFigures) {
  Result result = WithTask();
  EXPECT_THAT(ToText(TaskSection(result)), Not(HasSubstr("region as a whole")));
  result.task->aligned = true;
  result.task->left_out = {"joint_drift at joint 2"};
  EXPECT_THAT(ToText(TaskSection(result)),
              AllOf(HasSubstr("joint_drift at joint 2"), HasSubstr("the region as a whole was")));
}

TEST(TaskSection, IsEmptyWithoutATask) {
  EXPECT_TRUE(TaskSection(ExampleResult()).empty());
  EXPECT_EQ(TaskSentence(ExampleResult()), "");
}

}  // namespace
}  // namespace dhcal
