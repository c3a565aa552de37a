#include "core/io/text_file.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_file.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

/// The only message about a file that cannot be read.
std::string MessageAbout(const std::string& path) {
  Diagnostics diagnostics;
  EXPECT_EQ(ReadTextFile(path, &diagnostics), std::nullopt);
  EXPECT_EQ(diagnostics.num_errors(), 1);
  return diagnostics.ToString();
}

TEST(TextFile, ReturnsTheContentUnchanged) {
  const TempFile file("a\r\nb \n");
  Diagnostics diagnostics;
  EXPECT_EQ(ReadTextFile(file.path(), &diagnostics), "a\r\nb \n");
  EXPECT_TRUE(diagnostics.ok());
}

TEST(TextFile, DropsTheByteOrderMark) {
  const TempFile file("\xEF\xBB\xBFschema: 1\n");
  Diagnostics diagnostics;
  EXPECT_EQ(ReadTextFile(file.path(), &diagnostics), "schema: 1\n");
}

TEST(TextFile, MissingFileIsAnError) {
  EXPECT_THAT(MessageAbout("/nowhere/at all.yaml"),
              HasSubstr("/nowhere/at all.yaml: error: there is no such file"));
}

TEST(TextFile, FolderIsAnError) {
  EXPECT_THAT(MessageAbout(testing::TempDir()), HasSubstr("this is a folder"));
}

TEST(TextFile, EmptyFileIsAnError) {
  EXPECT_THAT(MessageAbout(TempFile("").path()), HasSubstr("the file is empty"));
}

TEST(TextFile, ByteOrderMarkAloneIsAnEmptyFile) {
  EXPECT_THAT(MessageAbout(TempFile("\xEF\xBB\xBF").path()), HasSubstr("the file is empty"));
}

TEST(TextFile, Utf16IsConverted) {
  // "q1", U+00E9 and U+1F916, which takes two units.
  const std::string little("\xFF\xFEq\0001\0\xE9\0\x3E\xD8\x16\xDD", 12);
  const std::string big("\xFE\xFF\0q\0001\0\xE9\xD8\x3E\xDD\x16", 12);
  for (const std::string& content : {little, big}) {
    const TempFile file(content);
    Diagnostics diagnostics;
    bool utf16 = false;
    EXPECT_EQ(ReadTextFile(file.path(), &diagnostics, &utf16), "q1\xC3\xA9\xF0\x9F\xA4\x96");
    EXPECT_TRUE(utf16);
    EXPECT_TRUE(diagnostics.ok());
  }
}

TEST(TextFile, BrokenUtf16IsAnError) {
  for (const std::string& content :
       {std::string("\xFF\xFEq", 3), std::string("\xFF\xFE\x3E\xD8", 4)}) {
    EXPECT_THAT(MessageAbout(TempFile(content).path()), HasSubstr("UTF-16 text with broken"));
  }
}

TEST(TextFile, WorkbooksAreTold) {
  EXPECT_THAT(MessageAbout(TempFile(std::string("PK\x03\x04\0", 5)).path()),
              HasSubstr("save it as 'CSV UTF-8'"));
}

TEST(TextFile, EndlessDeviceIsRefusedAtItsFirstNul) {
  EXPECT_THAT(MessageAbout("/dev/zero"), HasSubstr(":1:1: error: the file holds a NUL byte"));
}

TEST(TextFile, PlaceOfInvalidUtf8CountsLinesAndCharacters) {
  EXPECT_THAT(MessageAbout(TempFile("a\né\xFF").path()), HasSubstr(":2:2: error: the text is not"));
}

}  // namespace
}  // namespace dhcal
