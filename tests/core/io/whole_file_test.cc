#include "core/io/whole_file.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

TEST(WholeFile, ReplacesWhatIsThereAndLeavesNothingBeside) {
  const TempFolder folder;
  WriteFile(folder / "out.csv", "old");
  WriteFile(folder / "out.csv.partial", "of a run that was killed");
  Diagnostics diagnostics;
  EXPECT_TRUE(WriteWholeFile(folder / "out.csv", "new\n", &diagnostics));
  EXPECT_EQ(ReadFile(folder / "out.csv"), "new\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "out.csv.partial"));
  EXPECT_TRUE(diagnostics.ok());
}

TEST(WholeFile, SaysWhyItCannotWrite) {
  const TempFolder folder;
  Diagnostics diagnostics;
  EXPECT_FALSE(WriteWholeFile(folder / "none/out.csv", "text", &diagnostics));
  EXPECT_FALSE(WriteWholeFile(folder.path().string(), "text", &diagnostics));
  EXPECT_THAT(diagnostics.ToString(), testing::HasSubstr("cannot be written: No such file"));
  EXPECT_THAT(diagnostics.ToString(), testing::HasSubstr("is a folder"));
  EXPECT_FALSE(std::filesystem::exists(folder.path().string() + ".partial"));
}

}  // namespace
}  // namespace dhcal
