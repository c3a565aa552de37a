#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <signal.h>
#include <string>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/rng.h"
#include "core/report/report.h"
#include "core/report/text_renderer.h"
#include "problems/formats/result/result_writer.h"
#include "tests/support/example_result.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr char kOwnProblem[] = R"(schema: 1
name: kr15
robot:
  joints: [{d_m: 1}, {d_m: 2}, {d_m: 3}, {d_m: 4}, {d_m: 5}, {d_m: 6}]
measurement: {kind: position}
recording: data.csv
)";

/// A problem file and its recording in a folder, and a result to write.
class ResultFolderTest : public testing::Test {
 protected:
  ResultFolderTest() : spec_(ExampleSpec()), result_(ExampleResult()) {
    spec_.file = folder_ / "problem.yaml";
    spec_.recording = folder_ / "data.csv";
    WriteFile(spec_.file, kOwnProblem);
    WriteFile(spec_.recording, "the recording");
  }

  bool Write(const std::string& directory) {
    return WriteResult(spec_, recording_, result_, directory, &diagnostics_);
  }

  std::string Check(const std::string& directory) {
    Diagnostics diagnostics;
    CheckResultDirectory(directory, &diagnostics);
    return diagnostics.ToString();
  }

  /// Makes a file or, when the name ends with a slash, a folder in the result folder.
  void Put(const std::string& name) {
    fs::create_directories(fs::path(out_ + "/" + name).parent_path());
    if (name.back() != '/') WriteFile(out_ + "/" + name, "content");
  }

  const TempFolder folder_;
  const std::string out_ = folder_ / "out";
  ProblemSpec spec_;
  Recording recording_ = ExampleRecording();
  Result result_;
  Diagnostics diagnostics_;
};

TEST_F(ResultFolderTest, HoldsTheFilesOfTheFormat) {
  ASSERT_TRUE(Write(out_)) << diagnostics_.ToString();
  EXPECT_THAT(NamesIn(out_),
              UnorderedElementsAre("report.txt",
                                   "report.html",
                                   "result.json",
                                   "calibrated.yaml",
                                   "calibrated.py",
                                   "residuals.csv"));
  EXPECT_EQ(ReadFile(out_ + "/report.txt"), ToText(ReportOf(spec_, recording_, result_)));
  EXPECT_EQ(ReadFile(out_ + "/result.json"), ResultToJson(result_));
  EXPECT_EQ(ReadFile(out_ + "/residuals.csv"), ResidualsToCsv(result_, recording_));
  EXPECT_THAT(ReadFile(out_ + "/calibrated.yaml"), HasSubstr("recording: ../data.csv\n"));
  EXPECT_THAT(NamesIn(folder_.path()), UnorderedElementsAre("problem.yaml", "data.csv", "out"));
}

TEST_F(ResultFolderTest, StoresASimulatedRecording) {
  result_.simulated = true;
  spec_.recording.clear();
  ASSERT_TRUE(Write(out_)) << diagnostics_.ToString();
  EXPECT_EQ(ReadFile(out_ + "/recording.csv"), RecordingToCsv(recording_, spec_.robot));
  EXPECT_THAT(ReadFile(out_ + "/calibrated.yaml"), HasSubstr("recording: recording.csv\n"));
}

TEST_F(ResultFolderTest, HasNoCalibratedRobotWithoutAUsableFit) {
  result_ = DivergedResult();
  ASSERT_TRUE(Write(out_)) << diagnostics_.ToString();
  EXPECT_THAT(NamesIn(out_), UnorderedElementsAre("report.txt", "report.html", "result.json"));
}

TEST_F(ResultFolderTest, KeepsARecordingThatLiesInTheFolderToBeReplaced) {
  result_.simulated = true;
  ASSERT_TRUE(Write(out_));
  const std::string recording = ReadFile(out_ + "/recording.csv");
  // The result is run again in place, as a user may do with its calibrated.yaml.
  result_.simulated = false;
  spec_.file = out_ + "/calibrated.yaml";
  spec_.recording = out_ + "/recording.csv";
  ASSERT_TRUE(Write(out_)) << diagnostics_.ToString();
  EXPECT_EQ(ReadFile(out_ + "/recording.csv"), recording);
  EXPECT_THAT(ReadFile(out_ + "/calibrated.yaml"), HasSubstr("recording: recording.csv\n"));
}

TEST_F(ResultFolderTest, FollowsALinkToTheFolderThatItNames) {
  fs::create_directory(folder_.path() / "real");
  fs::create_directory_symlink(folder_.path() / "real", out_);
  ASSERT_TRUE(Write(out_ + "/")) << diagnostics_.ToString();
  EXPECT_TRUE(fs::is_symlink(out_));
  EXPECT_TRUE(fs::exists(folder_.path() / "real" / "result.json"));
}

TEST_F(ResultFolderTest, AcceptsAFolderThatIsAbsentEmptyOrAnEarlierResult) {
  EXPECT_EQ(Check(out_), "");
  EXPECT_EQ(Check(out_ + "/deep/below/"), "");
  fs::create_directory(out_);
  EXPECT_EQ(Check(out_), "");
  ASSERT_TRUE(Write(out_));
  EXPECT_EQ(Check(out_), "");
  Put("recording.csv");
  EXPECT_EQ(Check(out_), "");
}

TEST_F(ResultFolderTest, LeavesForeignFilesAlone) {
  ASSERT_TRUE(Write(out_));
  for (const char* const name : {"notes.txt", ".hidden", "recording.csv/"}) {
    Put(name);
    EXPECT_THAT(Check(out_), HasSubstr("not from an earlier result"));
    EXPECT_FALSE(Write(out_));
    EXPECT_TRUE(fs::exists(out_ + "/" + name));
    fs::remove_all(out_ + "/" + name);
  }
  EXPECT_EQ(ReadFile(out_ + "/report.txt"), ToText(ReportOf(spec_, recording_, result_)));
}

TEST_F(ResultFolderTest, NamesAtMostThreeForeignFiles) {
  for (const char* const name : {"a", "b", "c", "d", "e"}) Put(name);
  EXPECT_THAT(Check(out_), HasSubstr("(a, b, c and 2 more)"));
}

TEST_F(ResultFolderTest, TakesARecordingAloneForNoEarlierResult) {
  Put("recording.csv");
  EXPECT_THAT(Check(out_), HasSubstr("holds files but no result.json"));
  EXPECT_FALSE(Write(out_));
  EXPECT_EQ(ReadFile(out_ + "/recording.csv"), "content");
}

TEST_F(ResultFolderTest, RefusesWhatIsNoFolderName) {
  EXPECT_THAT(Check(""), HasSubstr("is no name for a result folder"));
  EXPECT_THAT(Check("/"), HasSubstr("is no name for a result folder"));
  EXPECT_THAT(Check("."), HasSubstr("current folder"));
  EXPECT_THAT(Check(spec_.file), HasSubstr("is not a folder"));
  EXPECT_THAT(Check(spec_.file + "/out"), HasSubstr("is not a folder"));
  EXPECT_NE(Check(folder_ / std::string(300, 'n')), "");
}

TEST_F(ResultFolderTest, SaysWhichFileHasGoneSinceItWasRead) {
  fs::remove(spec_.file);
  EXPECT_FALSE(Write(out_));
  EXPECT_THAT(diagnostics_.ToString(), HasSubstr("problem.yaml: error: "));
  EXPECT_FALSE(fs::exists(out_));
}

/// Runs `action` in a child process; true when it returned true.
bool InChild(const std::function<bool()>& action) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(action() ? 0 : 1);
  int status = 1;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST_F(ResultFolderTest, SaysWhyAParentCannotBeWritten) {
  const fs::path closed = folder_.path() / "closed";
  fs::create_directory(closed);
  ::chmod(folder_.path().c_str(), 0755);
  ::chmod(closed.c_str(), 0555);
  const bool told = InChild([&] {
    // The superuser may write everywhere; be somebody else.
    if (::geteuid() == 0 && (::setgid(65534) != 0 || ::setuid(65534) != 0)) return false;
    return Check((closed / "out").string()).find("Permission denied") != std::string::npos;
  });
  EXPECT_TRUE(told);
}

/// Writes two results in turn until it is killed.
[[noreturn]] void WriteForever(const ProblemSpec& spec,
                               const Recording& recording,
                               const std::string& out) {
  Result even = ExampleResult();
  even.simulated = true;
  even.problem = "even";
  Result odd = even;
  odd.problem = "odd";
  odd.residuals.clear();              // one file less
  setenv("PATH", "/nonexistent", 1);  // without gnuplot, which would take most of the time
  for (int i = 0;; ++i) {
    const Result& result = i % 2 == 0 ? even : odd;
    Diagnostics diagnostics;
    if (!WriteResult(spec, recording, result, out, &diagnostics)) ::_exit(1);
  }
}

/// Every file of the folder belongs to the same result, and none is missing.
void ExpectWhole(const std::string& out) {
  const std::string report = ReadFile(out + "/report.txt");
  const std::string which = report.find("calibration: even") != std::string::npos ? "even" : "odd";
  ASSERT_THAT(report, HasSubstr("calibration: " + which));
  const auto json = nlohmann::json::parse(ReadFile(out + "/result.json"), nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  EXPECT_EQ(json["problem"], which);
  EXPECT_EQ(NamesIn(out).size(), which == "even" ? 7u : 6u);
  EXPECT_EQ(fs::exists(out + "/residuals.csv"), which == "even");
  EXPECT_THAT(ReadFile(out + "/calibrated.yaml"), HasSubstr("recording: recording.csv\n"));
}

TEST_F(ResultFolderTest, IsWholeAfterAKillAtAnyMoment) {
  Rng rng(99);
  result_.simulated = true;
  const auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(Write(out_));
  std::chrono::duration<double, std::micro> once = std::chrono::steady_clock::now() - start;
  fs::remove_all(out_);
  bool existed = false;
  for (int i = 0; i < 40; ++i) {
    const pid_t child = ::fork();
    if (child == 0) WriteForever(spec_, recording_, out_);
    ::usleep(static_cast<useconds_t>(rng.Uniform(0, 4) * once.count()));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "the child failed";
    EXPECT_TRUE(fs::exists(out_) || !existed) << "the earlier result has gone";
    existed = fs::exists(out_);
    if (existed) ExpectWhole(out_);
    if (!existed) once *= 1.2;  // a machine that has become slower since
  }
  EXPECT_TRUE(existed);
  ASSERT_TRUE(Write(out_)) << diagnostics_.ToString();
  EXPECT_THAT(NamesIn(folder_.path()), ElementsAre("data.csv", "out", "problem.yaml"));
}

}  // namespace
}  // namespace dhcal
