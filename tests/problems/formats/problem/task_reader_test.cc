#include "problems/formats/problem/task_reader.h"

#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "problems/formats/problem/problem_reader.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

class TaskReader : public testing::Test {
 protected:
  /// The problem with this task; its messages are in `diagnostics_`.
  std::optional<ProblemSpec> Read(const std::string& task,
                                  const std::string& second_row = "{a_m: 0.2}") {
    WriteFile(folder_ / "p.yaml",
              "schema: 1\nrobot: {joints: [{a_m: 0.3, alpha_deg: 90}, " + second_row +
                  "]}\nmeasurement: {kind: position}\nrecording: r.csv\ntask: " + task + "\n");
    diagnostics_ = Diagnostics();
    return ReadProblemFile(folder_ / "p.yaml", "", &diagnostics_);
  }
  std::string Messages() const { return diagnostics_.ToString(); }

  TempFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(TaskReader, ReadsCornersInAnyOrderAndUnit) {
  const auto spec = Read("{box_mm: [[800, 300, 200], [1200, -300, 800]]}");
  ASSERT_TRUE(spec.has_value()) << Messages();
  ASSERT_TRUE(spec->task && spec->task->box);
  EXPECT_TRUE(spec->task->box->low.isApprox(Eigen::Vector3d(0.8, -0.3, 0.2), 1e-15));
  EXPECT_TRUE(spec->task->box->high.isApprox(Eigen::Vector3d(1.2, 0.3, 0.8), 1e-15));
}

TEST_F(TaskReader, ReadsTheJointColumnsOfAFileBesideTheProblem) {
  WriteFile(folder_ / "where.csv", "q1_deg,q2_deg\n90,0\n0,-45\n");
  const auto spec = Read("{poses: where.csv}");
  ASSERT_TRUE(spec.has_value()) << Messages();
  ASSERT_EQ(spec->task->q.rows(), 2);
  EXPECT_DOUBLE_EQ(spec->task->q(0, 0), kPi / 2);
  EXPECT_DOUBLE_EQ(spec->task->q(1, 1), -kPi / 4);
}

TEST_F(TaskReader, IsAbsentWithoutTheKey) {
  WriteFile(folder_ / "p.yaml",
            "schema: 1\nrobot: {joints: [{a_m: 0.3}]}\nmeasurement: {kind: position}\n"
            "recording: r.csv\n");
  const auto spec = ReadProblemFile(folder_ / "p.yaml", "", &diagnostics_);
  ASSERT_TRUE(spec.has_value());
  EXPECT_FALSE(spec->task.has_value());
}

TEST_F(TaskReader, RefusesWhatIsNoRegion) {
  const std::pair<const char*, const char*> cases[] = {
      {"{box_m: [[0, 0, 0]]}", "p.yaml:5:15: error: 'task.box_m' has 1 entries, but two opposite"},
      {"{box_m: [[0, 0, 0], [1, 0, 1]]}", "is flat"},
      {"{box_m: [[0, 0, 0], [1, x, 1]]}", "p.yaml:5"},
      {"{}", "'task' needs 'box_m'"},
      {"{box_m: [[0, 0, 0], [1, 1, 1]], poses: a.csv}", "keep one of them"},
      {"{bax_m: [[0, 0, 0], [1, 1, 1]]}", "box_m"},
      {"{poses: gone.csv}", "gone.csv"}};
  for (const auto& [task, message] : cases) {
    EXPECT_FALSE(Read(task).has_value()) << task;
    EXPECT_THAT(Messages(), HasSubstr(message)) << task;
  }
}

TEST_F(TaskReader, ABoxNeedsToKnowHowFarJointsSlide) {
  const char* const box = "{box_m: [[0, 0, 0], [1, 1, 1]]}";
  EXPECT_FALSE(Read(box, "{type: prismatic}").has_value());
  EXPECT_THAT(Messages(), HasSubstr("limits_mm"));
  EXPECT_TRUE(Read(box, "{type: prismatic, limits_mm: [0, 500]}").has_value()) << Messages();
}

}  // namespace
}  // namespace dhcal
