#include "core/io/mat_text.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_file.h"
#include "tests/support/temp_mat.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

std::optional<std::string> ReadMat(const std::string& path, std::string* messages) {
  FileErrors errors(path);
  std::optional<std::string> text = MatToText(path, &errors);
  Diagnostics diagnostics;
  errors.Report(&diagnostics);
  *messages = diagnostics.ToString();
  return text;
}

TEST(MatText, VectorsAndMatricesBecomeColumns) {
  std::vector<double> q = {1, 2, 3, 4.5, 5, 6}, t = {0, 1, 2}, one = {7};
  q[4] = std::nan("");
  for (const bool as_struct : {false, true}) {
    const TempMat file({MatVariable("q_deg", 3, 2, q.data()),
                        MatVariable("t_s", 1, 3, t.data()),
                        MatVariable("version", 1, 1, one.data())},
                       as_struct);
    std::string messages;
    EXPECT_EQ(ReadMat(file.path(), &messages), "q_deg(1),q_deg(2),t_s\n1,4.5,0\n2,,1\n3,6,2\n");
    EXPECT_THAT(messages,
                HasSubstr("variables left out, for they are no real numbers with 3 rows"));
    EXPECT_THAT(messages, HasSubstr("'version'"));
  }
}

TEST(MatText, OtherFilesAreRefused) {
  std::string messages;
  EXPECT_EQ(ReadMat(TempFile("q1_deg\n1\n", ".mat").path(), &messages), std::nullopt);
  EXPECT_THAT(messages, HasSubstr("this is no MATLAB file"));
  std::vector<double> one = {7};
  const TempMat file({MatVariable("version", 1, 1, one.data())}, false);
  EXPECT_EQ(ReadMat(file.path(), &messages), std::nullopt);
  EXPECT_THAT(messages, HasSubstr("save variables such as q_deg (n x joints)"));
}

}  // namespace
}  // namespace dhcal
