// Every file in tests/data/broken says in its first lines what is wrong with it:
//
//   # expect: <line>:<column>: <part of the message>    (":" alone when the place is the file)
//   # expect: problem:<line>:<column>: <part>           a place in the problem file
//   # joints: RP                                        a recording's robot; two revolute joints
//   # problem: <name>                                   a good problem that it must fit
//   # more errors follow                                not all are listed
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/diagnostics.h"
#include "problems/formats/problem/problem_checks.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;

const char kDataFolder[] = DHCAL_SOURCE_DIR "/tests/data/";

struct Expectation {
  std::string beginning;  // of the whole message
  std::string part;
};

struct BrokenFile {
  std::string path;
  std::string problem;  // "" = none
  std::string joints = "RR";
  std::vector<Expectation> expected;
  bool more_follow = false;
};

/// The rest of `line` after `key`, when it starts with it.
std::optional<std::string> After(const std::string& line, const std::string& key) {
  if (line.compare(0, key.size(), key) != 0) return std::nullopt;
  return line.substr(key.size());
}

Expectation ParseExpectation(const std::string& text, const BrokenFile& broken) {
  const std::size_t end = text.find(": ");
  std::string place = text.substr(0, end);
  std::string file = broken.path;
  if (const auto in_problem = After(place, "problem")) {
    file = broken.problem;
    place = in_problem->empty() ? "" : in_problem->substr(1);
  }
  return {file + (place.empty() ? "" : ":" + place) + ": error: ", text.substr(end + 2)};
}

BrokenFile ReadComments(const std::string& path) {
  BrokenFile broken;
  broken.path = path;
  std::ifstream stream(path, std::ios::binary);
  std::vector<std::string> expectations;
  for (std::string line; std::getline(stream, line);) {
    if (const auto text = After(line, "# expect: ")) expectations.push_back(*text);
    if (const auto joints = After(line, "# joints: ")) broken.joints = *joints;
    if (const auto name = After(line, "# problem: ")) {
      broken.problem = std::string(kDataFolder) + "good/" + *name;
    }
    if (After(line, "# more errors follow")) broken.more_follow = true;
  }
  for (const std::string& text : expectations) {
    broken.expected.push_back(ParseExpectation(text, broken));
  }
  return broken;
}

/// Reads the file as the program would; true when it was taken without an error.
bool Accepts(const BrokenFile& broken, Diagnostics* diagnostics) {
  if (fs::path(broken.path).extension() == ".yaml") {
    return ReadProblemFile(broken.path, "", diagnostics).has_value();
  }
  std::vector<JointRow> joints = JointsOf(broken.joints);
  std::optional<ProblemSpec> problem;
  if (!broken.problem.empty()) {
    problem = ReadProblemFile(broken.problem, "", diagnostics);
    if (!problem) return false;
    joints = problem->robot.joints;
  }
  const auto recording = ReadRecording(broken.path, joints, diagnostics);
  if (problem && recording) CheckRecordingFits(*problem, *recording, diagnostics);
  return diagnostics->ok() && recording.has_value();
}

bool Matches(const Diagnostic& diagnostic, const Expectation& expected) {
  const std::string message = diagnostic.ToString();
  return message.compare(0, expected.beginning.size(), expected.beginning) == 0 &&
         message.find(expected.part, expected.beginning.size()) != std::string::npos;
}

class BrokenInput : public testing::TestWithParam<std::string> {};

TEST_P(BrokenInput, IsRefusedWithItsPlaceAndReason) {
  const BrokenFile broken = ReadComments(GetParam());
  ASSERT_FALSE(broken.expected.empty()) << "the file says nothing of what to expect";
  Diagnostics diagnostics;
  EXPECT_FALSE(Accepts(broken, &diagnostics));
  for (const Expectation& expected : broken.expected) {
    const bool found = std::any_of(
        diagnostics.all().begin(), diagnostics.all().end(), [&](const Diagnostic& diagnostic) {
          return Matches(diagnostic, expected);
        });
    EXPECT_TRUE(found) << "no message\n  " << expected.beginning << "..." << expected.part
                       << "\namong\n"
                       << diagnostics.ToString();
  }
  if (broken.more_follow) return;
  EXPECT_EQ(diagnostics.num_errors(), static_cast<int>(broken.expected.size()))
      << "one mistake must give one message\n"
      << diagnostics.ToString();
}

std::vector<std::string> BrokenFiles() {
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(std::string(kDataFolder) + "broken")) {
    paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

INSTANTIATE_TEST_SUITE_P(Data,
                         BrokenInput,
                         testing::ValuesIn(BrokenFiles()),
                         [](const testing::TestParamInfo<std::string>& param) {
                           return fs::path(param.param).stem().string();
                         });

}  // namespace
}  // namespace dhcal
