#include "problems/formats/recording/import.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_file.h"

namespace dhcal {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string Imported(const std::string& text) {
  const TempFile file(text, ".csv");
  Diagnostics diagnostics;
  const auto columns = ImportColumns(file.path(), {}, &diagnostics);
  EXPECT_TRUE(columns.has_value()) << diagnostics.ToString();
  return columns.value_or("");
}

TEST(Import, SaysWhatIsSureAndWhatIsAGuess) {
  const std::string yaml = Imported("J1,J2,J3,X,Y [mm],Z [mm],note\n1,2,3,400,500,600,hello\n");
  EXPECT_THAT(yaml, HasSubstr("columns:\n"));
  EXPECT_THAT(yaml, HasSubstr("  q1_rad: J1"));
  EXPECT_THAT(yaml, HasSubstr("# GUESS, check the unit: 1\n"));
  EXPECT_THAT(yaml, HasSubstr("  x_mm: X "));
  EXPECT_THAT(yaml, HasSubstr("  y_mm: \"Y [mm]\" "));
  EXPECT_THAT(yaml, HasSubstr("# by its name: 500\n"));
  EXPECT_THAT(yaml, HasSubstr("#   note: hello\n"));
}

TEST(Import, WithoutHeaderColumnsAreNumbered) {
  const std::string yaml =
      Imported("100 20 30 40 50 60 1000 200 300\n10 20 30 40 50 60 1000 200 300\n");
  EXPECT_THAT(yaml, HasSubstr("  q1_deg: 1 "));
  EXPECT_THAT(yaml, HasSubstr("  q6_deg: 6 "));
  EXPECT_THAT(yaml, HasSubstr("  z_mm: 9 "));
}

TEST(Import, RotationNamesAreLeftToTheUser) {
  const std::string yaml = Imported("q1_deg,q2_deg,rx,ry,rz\n1,2,0.1,0.2,0.3\n");
  EXPECT_THAT(yaml, HasSubstr("  # rotvec_x_rad: rx\n"));
  EXPECT_THAT(yaml, HasSubstr("  # euler_xyz_z_rad: rz\n"));
  EXPECT_THAT(yaml, Not(HasSubstr("\n  rotvec_x")));
}

}  // namespace
}  // namespace dhcal
