// The program as a user runs it: exit status, what it prints, what it writes.

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <sys/wait.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/files.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct Outcome {
  int exit_status = -1;
  std::string out, err;
};

std::string ReadAll(const fs::path& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Runs the program in a scratch folder of its own.
class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "dhcal_program_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    fs::create_directory(folder_ / "work");
  }
  void TearDown() override { fs::remove_all(folder_); }

  Outcome Run(const std::string& arguments) const {
    const std::string command = "cd '" + (folder_ / "work").string() + "' && '" DHCAL_PROGRAM "' " +
                                arguments + " > ../out 2> ../err";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), ReadAll(folder_ / "out"), ReadAll(folder_ / "err")};
  }

  static std::string Case(const std::string& name) {
    return "--problem '" + SourcePath("problems/cases/" + name + ".yaml") + "' ";
  }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / "work" / name) << text;
  }

  std::set<std::string> Files(const std::string& relative) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "work" / relative)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

  nlohmann::json Json(const std::string& relative) const {
    return nlohmann::json::parse(ReadAll(folder_ / "work" / relative));
  }

  fs::path folder_;
};

TEST_F(Program, WritesTheWholeResultFolderAndPrintsItsReport) {
  const Outcome outcome = Run(Case("kr15"));
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_EQ(Files("."), std::set<std::string>{"kr15_result"});
  EXPECT_EQ(Files("kr15_result"),
            (std::set<std::string>{"calibrated.py",
                                   "calibrated.yaml",
                                   "recording.csv",
                                   "report.html",
                                   "report.txt",
                                   "residuals.csv",
                                   "result.json"}));
  EXPECT_LT(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 25) << "one screen";
  EXPECT_THAT(outcome.out, HasSubstr("Files kr15_result/: calibrated.yaml"));
  const std::string report = ReadAll(folder_ / "work/kr15_result/report.txt");
  const std::string verbose = Run(Case("kr15") + "--verbose").out;
  EXPECT_THAT(verbose, HasSubstr(ReadAll(folder_ / "work/kr15_result/report.txt")));
  EXPECT_THAT(report, HasSubstr("only d2 + d3 is determined: axes 2 and 3 are parallel"));
  EXPECT_THAT(report, HasSubstr("theta6 turns about an axis through the measured point"));
  const auto fit = Json("kr15_result/result.json")["fits"][0];
  EXPECT_EQ(fit["iterations"], 2);
  EXPECT_EQ(fit["rank"], 23);
}

TEST_F(Program, QuietPrintsNothing) {
  const Outcome outcome = Run(Case("kr15") + "--quiet");
  EXPECT_EQ(outcome.exit_status, 0);
  EXPECT_THAT(outcome.out + outcome.err, IsEmpty());
}

/// The problem file of a case, joint 2 of which counts the other way.
std::string WithWrongSense(const std::string& problem) {
  std::istringstream lines(problem);
  std::string text;
  int joint = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool is_row = line.find("- {theta_deg") != std::string::npos;
    if (is_row && ++joint == 2) line.insert(line.find('}'), ", sign: -1");
    text += line + "\n";
  }
  return text;
}

TEST_F(Program, KeepsTheGeometryWhenItIsInterrupted) {
  std::string problem = ReadAll(SourcePath("problems/cases/kr15_left_out.yaml"));
  const std::string count = "    poses: 150";
  ASSERT_NE(problem.find(count), std::string::npos);
  Write("long.yaml", problem.replace(problem.find(count), count.size(), "    poses: 4000"));
  // SIGTERM as Ctrl-C: a shell lets its background jobs ignore SIGINT.
  const std::string command = "cd '" + (folder_ / "work").string() +
                              "' && ('" DHCAL_PROGRAM
                              "' --problem long.yaml --out r > ../out 2> ../err & p=$!; "
                              "while [ ! -e r/result.json ] && kill -0 $p; do sleep 0.02; done; "
                              "sleep 0.2; "
                              "kill -TERM $p; wait $p)";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 128 + SIGTERM);
  EXPECT_THAT(ReadAll(folder_ / "err"), HasSubstr("Interrupted. The geometry is in r/"));
  EXPECT_EQ(Files("r").count("calibrated.yaml"), 1U);
  EXPECT_THAT(ReadAll(folder_ / "work/r/report.txt"), HasSubstr("physics had not ended"));
  EXPECT_FALSE(Json("r/result.json").contains("diagnosis"));
}

TEST_F(Program, KeepsTheCuredGeometryWithTheCuredRecording) {
  const std::string folder = SourcePath("problems/cases/concealed/D5_kr15_01/");
  Write("recording.csv", ReadAll(folder + "recording.csv"));
  Write("wrong.yaml", WithWrongSense(ReadAll(folder + "problem.yaml")));
  // The diagnosis takes a while; whatever is there first must stand by itself.
  const std::string command = "cd '" + (folder_ / "work").string() +
                              "' && ('" DHCAL_PROGRAM
                              "' --problem wrong.yaml --try_fix --out r > ../out 2> ../err & p=$!; "
                              "while [ ! -e r/result.json ] && kill -0 $p; do sleep 0.005; done; "
                              "kill -TERM $p; wait $p)";
  EXPECT_NE(std::system(command.c_str()), -1);
  EXPECT_EQ(Json("r/result.json")["setup"]["cured"], true);
  EXPECT_EQ(Files("r").count("recording.csv"), 1U);
  EXPECT_EQ(Run("--problem r/calibrated.yaml --diagnosis never --out again").exit_status, 0);
}

TEST_F(Program, SaysWhereItLookedForARecordingThatIsNotThere) {
  std::string problem = ReadAll(SourcePath("problems/cases/concealed/D5_kr15_01/problem.yaml"));
  Write("problem.yaml", problem);
  Write("recordings.csv", "");
  const Outcome run = Run("--problem problem.yaml");
  EXPECT_EQ(run.exit_status, 2);
  EXPECT_THAT(run.err, ContainsRegex("problem.yaml:[0-9]+:[0-9]+: error: the recording"));
  EXPECT_THAT(run.err, HasSubstr("/work has no 'recording.csv'; did you mean 'recordings.csv'?"));
}

TEST_F(Program, DivergedFitExitsWithOneAndStillReports) {
  const Outcome outcome = Run(Case("kr15_noisy_paper_rule") + "--out result");
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(ReadAll(folder_ / "work/result/report.txt"), HasSubstr("Diverged"));
  const auto json = Json("result/result.json");
  EXPECT_EQ(json["fits"][0]["termination"], "diverged");
  EXPECT_FALSE(json["fits"][0].contains("parameters"));
  EXPECT_EQ(Files("result").count("calibrated.yaml"), 0u);
}

TEST_F(Program, WrongFilesExitWithOneAndNameTheLine) {
  const std::string folder = SourcePath("problems/cases/concealed/D5_kr15_01/");
  Write("recording.csv", ReadAll(folder + "recording.csv"));
  Write("wrong.yaml", WithWrongSense(ReadAll(folder + "problem.yaml")));
  const Outcome run = Run("--problem wrong.yaml --diagnosis never --out r");
  EXPECT_EQ(run.exit_status, 1);
  EXPECT_THAT(run.out, AllOf(HasSubstr("IMPLAUSIBLE"), HasSubstr("Joint 2 counts the other way")));
  const nlohmann::json setup = Json("r/result.json")["setup"];
  EXPECT_EQ(setup["plausible"], false);
  ASSERT_EQ(setup["causes"].size(), 1U);
  EXPECT_EQ(setup["causes"][0]["kind"], "joint_sense");
  EXPECT_EQ(setup["causes"][0]["fix"]["text"], "sign: 1");
  EXPECT_GT(setup["causes"][0]["fix"]["line"], 0);
  EXPECT_FALSE(fs::exists(folder_ / "work" / "r" / "calibrated.yaml"));
}

TEST_F(Program, TryFixRunsOnWithTheCureInTheResultFolderOnly) {
  const std::string folder = SourcePath("problems/cases/concealed/D5_kr15_01/");
  Write("recording.csv", ReadAll(folder + "recording.csv"));
  Write("wrong.yaml", WithWrongSense(ReadAll(folder + "problem.yaml")));
  const std::string before = ReadAll(folder_ / "work" / "wrong.yaml");
  const Outcome run = Run("--problem wrong.yaml --diagnosis never --out r --try-fix");
  EXPECT_EQ(run.exit_status, 0);
  EXPECT_EQ(Json("r/result.json")["setup"]["cured"], true);
  EXPECT_EQ(ReadAll(folder_ / "work" / "wrong.yaml"), before);
  // What was written runs by itself.
  const Outcome again = Run("--problem r/calibrated.yaml --diagnosis never --out again");
  EXPECT_EQ(again.exit_status, 0) << again.out << again.err;
  EXPECT_EQ(Json("again/result.json")["setup"]["plausible"], true);
}

TEST_F(Program, FlagsOverrideTheFile) {
  const Outcome outcome =
      Run(Case("kr15_noisy") + "--singular_value_tolerance=paper --method=both --out r");
  const auto json = Json("r/result.json");
  ASSERT_EQ(json["fits"].size(), 2u) << outcome.err;
  EXPECT_EQ(json["fits"][0]["termination"], "diverged");
}

TEST_F(Program, BadInputExitsWithTwoAndWritesNothing) {
  Write("bad.yaml", "schema: 1\nname: bad\nrobott: {}\n");
  const Outcome outcome = Run("--problem bad.yaml");
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("bad.yaml:3:1: error:"), HasSubstr("robot")));
  EXPECT_EQ(Files("."), std::set<std::string>{"bad.yaml"});
}

TEST_F(Program, OneBadProblemOfSeveralStopsAllBeforeAnythingIsWritten) {
  Write("bad.yaml", "schema: 2\n");
  const Outcome outcome = Run(Case("kr15") + "--problem bad.yaml --problem absent.yaml");
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("bad.yaml:1"), HasSubstr("absent.yaml")));
  EXPECT_EQ(Files("."), std::set<std::string>{"bad.yaml"});
}

TEST_F(Program, MoreParametersThanReadingsIsBadInput) {
  std::string text = ReadAll(SourcePath("problems/cases/kr15.yaml"));
  const std::size_t at = text.find("poses: 100");
  Write("few.yaml", text.replace(at, 10, "poses: 7"));
  const Outcome outcome = Run("--problem few.yaml");
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("fewer than the 24 free parameters"));
}

TEST_F(Program, SeveralProblemsGiveASummaryTable) {
  const Outcome outcome = Run(Case("kr15") + Case("kr15_noisy") + "--out all");
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(Files("all"), (std::set<std::string>{"kr15_result", "kr15_noisy_result"}));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("23/24"), HasSubstr("20/24")));
}

TEST_F(Program, ACommaSeparatesProblemsUnlessItIsPartOfAName) {
  const std::string kr15 = ReadAll(SourcePath("problems/cases/kr15.yaml"));
  Write("a,b.yaml", kr15);
  EXPECT_EQ(Run("--problem a,b.yaml --quiet").exit_status, 0);
  Write("c.yaml", kr15);
  EXPECT_THAT(Run("--problem c.yaml,d.yaml").err, HasSubstr("d.yaml"));
}

TEST_F(Program, TwoProblemsWithOneFolderAreRefused) {
  const Outcome outcome = Run(Case("kr15") + Case("kr15"));
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("different names"));
}

TEST_F(Program, CalibratedFileRunsAgainAndHasNothingLeftToCorrect) {
  ASSERT_EQ(Run(Case("kr15_noisy") + "--out first").exit_status, 0);
  const Outcome again = Run("--problem first/calibrated.yaml --out second");
  EXPECT_EQ(again.exit_status, 0) << again.err;
  const auto before = Json("first/result.json")["fits"][0];
  const auto after = Json("second/result.json")["fits"][0];
  EXPECT_NEAR(after["rms_m"].get<double>(), before["rms_m"].get<double>(), 1e-9);
  for (const auto& parameter : after["parameters"]) {
    EXPECT_LT(std::abs(parameter["correction"].get<double>()), 1e-8) << parameter["name"];
  }
}

TEST_F(Program, ForeignFilesInTheResultFolderAreNeverTouched) {
  fs::create_directory(folder_ / "work/mine");
  Write("mine/thesis.txt", "years of work");
  const Outcome outcome = Run(Case("kr15") + "--out mine");
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("thesis.txt"));
  EXPECT_EQ(Files("mine"), std::set<std::string>{"thesis.txt"});
}

TEST_F(Program, WrongFlagsSayWhatToDo) {
  for (const char* const arguments :
       {"", "--problm x.yaml", "--problem", "--out", "--quiet=perhaps --problem x.yaml"}) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_status, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr("--help")) << arguments;
  }
  const Outcome method = Run(Case("kr15") + "--method newton");
  EXPECT_EQ(method.exit_status, 2);
  EXPECT_THAT(method.err, HasSubstr("svd_gauss_newton"));
}

TEST_F(Program, ImportPrintsColumnsForTheProblemFile) {
  Write("rows.csv", "J1;J2;x [mm];y [mm];z [mm]\n100,5;2;3;4;5\n-60;20;3;4;5\n");
  const Outcome outcome = Run("--import rows.csv");
  EXPECT_EQ(outcome.exit_status, 0);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("columns:\n  q1_deg: J1"), HasSubstr("x_mm: \"x [mm]\"")));
  EXPECT_THAT(outcome.err,
              HasSubstr("note: read with semicolons between cells and decimal commas"));
  EXPECT_EQ(Run("--import nowhere.csv").exit_status, 2);
}

TEST_F(Program, HelpAndVersionExitWithZero) {
  const Outcome help = Run("--help");
  EXPECT_EQ(help.exit_status, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("--problem FILE"), HasSubstr("Exit status")));
  EXPECT_THAT(Run("--version").out, HasSubstr("ceres_dhcal " DHCAL_VERSION));
}

TEST_F(Program, OutputDoesNotDependOnTheLocale) {
  const Outcome plain = Run(Case("kr15_noisy") + "--out a");
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  Run(Case("kr15_noisy") + "--out b");
  unsetenv("LC_ALL");
  EXPECT_EQ(ReadAll(folder_ / "work/a/residuals.csv"), ReadAll(folder_ / "work/b/residuals.csv"));
  EXPECT_THAT(plain.out, Not(HasSubstr("nan")));
}

TEST_F(Program, InitWritesAProblemFileOnceAndNeverOverAnother) {
  const Outcome first = Run("init ur5e --out cell");
  EXPECT_EQ(first.exit_status, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("ceres_dhcal --problem cell/problem.yaml"));
  const std::string text = ReadAll(folder_ / "work/cell/problem.yaml");
  EXPECT_THAT(text, AllOf(HasSubstr("a_mm: -392.2"), HasSubstr("TO DO")));
  Write("cell/problem.yaml", "mine");
  const Outcome again = Run("init ur10 --out cell");
  EXPECT_EQ(again.exit_status, 2);
  EXPECT_THAT(again.err, HasSubstr("cell/problem.yaml is there already and stays as it is"));
  EXPECT_EQ(ReadAll(folder_ / "work/cell/problem.yaml"), "mine");
}

TEST_F(Program, AnInitializedProblemAsksForItsRecordingOnly) {
  ASSERT_EQ(Run("init kuka_kr6_r900").exit_status, 0);
  const Outcome outcome = Run("--problem problem.yaml");
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("my_recording.csv"), HasSubstr("1 error in the input")));
}

TEST_F(Program, InitNamesTheNearestRobotAndListsAll) {
  const Outcome wrong = Run("init ur5ee");
  EXPECT_EQ(wrong.exit_status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'ur5e'?"));
  for (const char* const bad : {"init", "init ../ur5e", "init ur5e ur3", "init ur5e --colour"}) {
    EXPECT_EQ(Run(bad).exit_status, 2) << bad;
  }
  EXPECT_THAT(Files("."), IsEmpty());
  const Outcome list = Run("init --list");
  EXPECT_EQ(list.exit_status, 0);
  EXPECT_THAT(list.out, AllOf(HasSubstr("ur5e"), HasSubstr("Universal Robots UR5e")));
}

TEST_F(Program, AcceptEndsInThreeWhereTheErrorIsLargerAndTheResultStands) {
  const std::string run = Case("kr15_noisy") + "--diagnosis never ";
  const Outcome met = Run(run + "--accept 1mm");
  EXPECT_EQ(met.exit_status, 0) << met.err;
  EXPECT_THAT(met.out, HasSubstr("Accepted: on rows that were not fitted"));
  const Outcome missed = Run(run + "--accept 1um --quiet");
  EXPECT_EQ(missed.exit_status, 3);
  EXPECT_THAT(missed.err, AllOf(HasSubstr("kr15_noisy: not accepted"), HasSubstr("asked for")));
  EXPECT_THAT(Files("kr15_noisy_result"), ::testing::Contains("calibrated.yaml"));
  EXPECT_EQ(Run(run + "--accept 1").exit_status, 2);
}

}  // namespace
}  // namespace dhcal
