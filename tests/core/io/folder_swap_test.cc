#include "core/io/folder_swap.h"

#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/posix_file.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::string> kOwnNames = {"one", "two"};

bool Replace(const std::filesystem::path& folder,
             const std::string& content,
             SwapMethod method,
             Diagnostics* diagnostics) {
  return ReplaceFolder(
      folder, {{"one", content}, {"two", content}}, kOwnNames, method, diagnostics);
}

/// The number of a process that has ended.
int DeadProcess() {
  const pid_t process = ::fork();
  if (process == 0) ::_exit(0);
  ::waitpid(process, nullptr, 0);
  return process;
}

std::string LeftoverName(int process, const std::string& ending) {
  return ".out." + HostName() + "." + std::to_string(process) + ending;
}

void MakeFolder(const std::filesystem::path& folder, const std::string& content) {
  std::filesystem::create_directory(folder);
  WriteFile(folder / "one", content);
}

class ReplaceFolderTest : public testing::TestWithParam<SwapMethod> {};

TEST_P(ReplaceFolderTest, MakesAndReplacesTheFolderAndLeavesNothingElse) {
  const TempFolder parent;
  const std::filesystem::path out = parent.path() / "made" / "on the way" / "out";
  Diagnostics diagnostics;
  for (const std::string content : {"first", "second", "third"}) {
    ASSERT_TRUE(Replace(out, content, GetParam(), &diagnostics)) << diagnostics.ToString();
    EXPECT_EQ(ReadFile(out / "one"), content);
    EXPECT_EQ(ReadFile(out / "two"), content);
    EXPECT_THAT(NamesIn(out.parent_path()), ElementsAre("out"));
  }
  EXPECT_THAT(diagnostics.all(), IsEmpty());
}

TEST_P(ReplaceFolderTest, NeverDeletesAFileThatIsNotItsOwn) {
  const TempFolder parent;
  const std::filesystem::path out = parent.path() / "out";
  MakeFolder(out, "old");
  WriteFile(out / "thesis.tex", "years of work");
  Diagnostics diagnostics;
  ASSERT_TRUE(Replace(out, "new", GetParam(), &diagnostics));
  EXPECT_EQ(ReadFile(out / "one"), "new");
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].severity, Severity::kWarning);
  const std::filesystem::path kept = diagnostics.all()[0].where.file;
  EXPECT_EQ(ReadFile(kept / "thesis.tex"), "years of work");
}

INSTANTIATE_TEST_SUITE_P(Methods,
                         ReplaceFolderTest,
                         testing::Values(SwapMethod::kExchange, SwapMethod::kRenameTwice));

TEST(ReplaceFolder, IsNeverSeenWithoutAFolder) {
  const TempFolder parent;
  const std::filesystem::path out = parent.path() / "out";
  MakeFolder(out, "old");
  const pid_t writer = ::fork();
  if (writer == 0) {
    Diagnostics diagnostics;
    bool good = true;
    for (int i = 0; i < 400; ++i) good &= Replace(out, "new", SwapMethod::kExchange, &diagnostics);
    ::_exit(good ? 0 : 1);
  }
  // What a reader sees at any moment is what a kill at that moment leaves.
  int missing = 0;
  int status = 1;
  while (::waitpid(writer, &status, WNOHANG) == 0) {
    for (int i = 0; i < 1000; ++i) missing += ::access((out / "one").c_str(), F_OK) == 0 ? 0 : 1;
  }
  EXPECT_EQ(missing, 0);
  EXPECT_EQ(status, 0);
}

TEST(ReplaceFolder, CleansWhatAKilledProcessLeft) {
  const TempFolder parent;
  const int dead = DeadProcess();
  MakeFolder(parent.path() / LeftoverName(dead, ".partial"), "half");
  MakeFolder(parent.path() / LeftoverName(dead, ".old"), "old");
  MakeFolder(parent.path() / LeftoverName(::getppid(), ".partial"), "at work");
  MakeFolder(parent.path() / ".out.elsewhere.1.partial", "another machine's");
  MakeFolder(parent.path() / "out", "current");
  Diagnostics diagnostics;
  ASSERT_TRUE(Replace(parent.path() / "out", "new", SwapMethod::kExchange, &diagnostics));
  EXPECT_THAT(NamesIn(parent.path()),
              testing::UnorderedElementsAre(
                  "out", ".out.elsewhere.1.partial", LeftoverName(::getppid(), ".partial")));
}

TEST(ReplaceFolder, BringsTheOldFolderBackWhenAKillTookItAway) {
  const TempFolder parent;
  MakeFolder(parent.path() / LeftoverName(DeadProcess(), ".old"), "the only copy");
  Diagnostics diagnostics;
  // The new content cannot be written, so the old must be there afterwards.
  EXPECT_FALSE(ReplaceFolder(parent.path() / "out",
                             {{"no/such/folder", "x"}},
                             kOwnNames,
                             SwapMethod::kExchange,
                             &diagnostics));
  EXPECT_EQ(ReadFile(parent.path() / "out" / "one"), "the only copy");
  EXPECT_THAT(NamesIn(parent.path()), ElementsAre("out"));
}

TEST(ReplaceFolder, LeavesTheOldFolderWhenTheNewCannotBeWritten) {
  const TempFolder parent;
  const std::filesystem::path out = parent.path() / "out";
  MakeFolder(out, "old");
  Diagnostics diagnostics;
  EXPECT_FALSE(ReplaceFolder(out,
                             {{"one", "new"}, {std::string(300, 'n'), "x"}},
                             kOwnNames,
                             SwapMethod::kExchange,
                             &diagnostics));
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("cannot be written: File name too long"));
  EXPECT_EQ(ReadFile(out / "one"), "old");
  EXPECT_THAT(NamesIn(parent.path()), ElementsAre("out"));
}

TEST(ReplaceFolder, SaysWhyAFolderCannotBeMade) {
  const TempFolder parent;
  WriteFile(parent.path() / "file", "");
  Diagnostics diagnostics;
  EXPECT_FALSE(Replace(parent.path() / "file" / "out", "new", SwapMethod::kExchange, &diagnostics));
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("Not a directory"));
}

}  // namespace
}  // namespace dhcal
