// Numbers are read the same wherever the program runs.
#include <clocale>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/comma_locale.h"
#include "tests/support/temp_file.h"

namespace dhcal {
namespace {

/// Decimal commas and grouped thousands, in C++ always and in C where such a locale is installed.
class InputInCommaLocale : public testing::Test {
 protected:
  InputInCommaLocale() : c_before_(std::setlocale(LC_ALL, nullptr)) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "da_DK.UTF-8"}) {
      if (std::setlocale(LC_ALL, name) != nullptr) break;
    }
  }
  ~InputInCommaLocale() override { std::setlocale(LC_ALL, c_before_.c_str()); }

 private:
  CommaLocale comma_locale_;
  std::string c_before_;
};

TEST_F(InputInCommaLocale, ProblemHasTheSameNumbers) {
  const TempFile file(
      "schema: 1\nrobot: {joints: [{a_m: 0.3125, d_mm: 1234.5}]}\n"
      "measurement: {kind: position}\nrecording: a.csv\nsolver: {max_iterations: 1234}\n");
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(file.path(), "", &diagnostics);
  ASSERT_TRUE(spec.has_value()) << diagnostics.ToString();
  EXPECT_EQ(spec->robot.joints[0].a, 0.3125);
  EXPECT_DOUBLE_EQ(spec->robot.joints[0].d, 1.2345);
  EXPECT_EQ(spec->solver.max_iterations, 1234);
}

TEST_F(InputInCommaLocale, RecordingHasTheSameNumbers) {
  const TempFile file("q1_rad,x_m,y_m,z_m\n0.5,1.25,1234.5,-2.5e-1\n");
  Diagnostics diagnostics;
  const auto recording = ReadRecording(file.path(), {JointRow()}, &diagnostics);
  ASSERT_TRUE(recording.has_value()) << diagnostics.ToString();
  EXPECT_EQ(recording->q(0, 0), 0.5);
  EXPECT_EQ(recording->p_WQ.row(0), Eigen::RowVector3d(1.25, 1234.5, -0.25));
}

TEST_F(InputInCommaLocale, MessagesHaveDecimalPoints) {
  const TempFile file(
      "schema: 1\nrobot: {joints: [{a_m: 1}]}\nmeasurement: {kind: position}\nrecording: a.csv\n"
      "solver: {max_iterations: 20000}\n");
  Diagnostics diagnostics;
  EXPECT_EQ(ReadProblemFile(file.path(), "", &diagnostics), std::nullopt);
  EXPECT_THAT(diagnostics.ToString(), testing::HasSubstr("a whole number from 1 to 10000"));
}

}  // namespace
}  // namespace dhcal
