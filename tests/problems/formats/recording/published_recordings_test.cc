// Recordings that others wrote, as they wrote them.
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "problems/formats/problem/problem_checks.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/files.h"
#include "tests/support/problem_cases.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

TEST(PublishedRecording, IpaSeriesBIsThatOfOurOwnForm) {
  if (DataDir().empty()) GTEST_SKIP() << "set DHCAL_DATA to the folder that holds ipa_ur10/";
  const ProblemSpec spec = LoadCase("ur10_ipa_b_as_published");
  Diagnostics diagnostics;
  const auto read = ReadRecording(spec.recording, spec.robot.joints, spec.columns, &diagnostics);
  ASSERT_TRUE(read.has_value()) << diagnostics.ToString();
  EXPECT_THAT(diagnostics.ToString(),
              HasSubstr("note: read with semicolons between cells and decimal commas\n"));
  const Recording ours = RecordingOf(LoadCase("ur10_ipa_b"));
  ASSERT_EQ(read->num_rows(), ours.num_rows());
  EXPECT_LT((read->q - ours.q).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((read->p_WQ - ours.p_WQ).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((read->temperature - ours.temperature).cwiseAbs().maxCoeff(), 0.01);
  // Intrinsic XYZ: the turn between the two, as far as eight digits tell it.
  for (int row = 0; row < ours.num_rows(); ++row) {
    const double cosine = std::abs(read->quaternion.row(row).dot(ours.quaternion.row(row)));
    EXPECT_GT(cosine, 1 - 1e-12) << "row " << row;
  }
  // The time stamp is the same in all rows.
  EXPECT_EQ(read->time.size(), 0);
}

/// What a run of one of the cases in forms_open says, with the names of files left out.
std::string MessagesOf(const std::string& name, bool* read) {
  const std::string folder = SharedDir() + "/cases/forms_open/";
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(folder + name + ".yaml", "", &diagnostics);
  if (!spec) return diagnostics.ToString();
  const auto recording =
      ReadRecording(spec->recording, spec->robot.joints, spec->columns, &diagnostics);
  if (recording) CheckRecordingFits(*spec, *recording, &diagnostics);
  *read = recording.has_value() && diagnostics.ok();
  return diagnostics.ToString();
}

TEST(PublishedRecording, OpenFormsAreReadOrSayWhatToDo) {
  if (SharedDir().empty()) {
    GTEST_SKIP() << "set DHCAL_SHARED to the folder that holds cases/ to run this test";
  }
  const struct {
    const char* name;
    bool read;
    const char* says;
  } kForms[] = {
      {"comma_after_rows", true, "read with the comma at the end of rows"},
      {"dash", true, "read with '-' as blank cells"},
      {"no_header", false, "row 1 holds numbers: the header is missing"},
      {"no_header_spaces", false, "row 1 holds numbers: the header is missing"},
      {"rotation_vector", false, "columns: {rotvec_x_rad: rx_rad"},
      {"word_nan", true, "read with 'NaN' as blank cells"},
  };
  for (const auto& form : kForms) {
    bool read = false;
    const std::string messages = MessagesOf(form.name, &read);
    EXPECT_EQ(read, form.read) << form.name << "\n" << messages;
    EXPECT_THAT(messages, HasSubstr(form.says)) << form.name;
  }
}

}  // namespace
}  // namespace dhcal
