#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/formats/result/result_writer.h"
#include "tests/support/comma_locale.h"
#include "tests/support/example_result.h"

namespace dhcal {
namespace {

using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// One row of kind pose with numbers that are exact in millimetres.
Result PoseResult() {
  Result result;
  result.coordinate_names = {"x", "rx"};
  RowResidual row;
  row.row_idx = 2;
  row.measured = Eigen::Vector2d(0.5, 0.25);
  row.predicted_before = Eigen::Vector2d(0.75, kNotSet);
  row.residual = Eigen::Vector2d(-0.25, 0.125);
  result.residuals = {row};
  return result;
}

TEST(ResidualsToCsv, NamesTheUnitOfEachColumn) {
  const std::string csv = ResidualsToCsv(PoseResult(), Recording());
  EXPECT_EQ(Lines(csv)[0],
            "row,run,set,measured_x_mm,predicted_before_x_mm,predicted_after_x_mm,residual_x_mm,"
            "standardised_x,measured_rx_mrad,predicted_before_rx_mrad,predicted_after_rx_mrad,"
            "residual_rx_mrad,standardised_rx,leverage");
}

TEST(ResidualsToCsv, LeavesCellsBlankThatWereNotComputed) {
  const std::vector<std::string> lines = Lines(ResidualsToCsv(PoseResult(), Recording()));
  ASSERT_THAT(lines, SizeIs(2));
  EXPECT_EQ(lines[1], "3,,train,500,750,,-250,,250,,,125,,");
}

TEST(ResidualsToCsv, HasOneLinePerRowWithItsLabels) {
  Recording recording = ExampleRecording();
  recording.target_names = {"A, upper", "B"};
  recording.target_idx.assign(12, 0);
  recording.target_idx[1] = 1;
  const std::vector<std::string> lines = Lines(ResidualsToCsv(ExampleResult(), recording));
  ASSERT_THAT(lines, SizeIs(13));
  EXPECT_THAT(lines[0], StartsWith("row,run,target,set,"));
  EXPECT_THAT(lines[1], StartsWith("1,morning,\"A, upper\",train,"));
  EXPECT_THAT(lines[2], StartsWith("2,morning,B,test,"));
  EXPECT_THAT(lines[12], StartsWith("12,evening,"));
}

TEST(ResidualsToCsv, IsTheSameUnderACommaDecimalLocale) {
  const std::string expected = ResidualsToCsv(ExampleResult(), ExampleRecording());
  const CommaLocale locale;
  EXPECT_EQ(ResidualsToCsv(ExampleResult(), ExampleRecording()), expected);
}

}  // namespace
}  // namespace dhcal
