#include "core/io/process.h"

#include <chrono>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace dhcal {
namespace {

using End = ProcessOutput::End;
constexpr std::chrono::seconds kEnough(20);

TEST(Process, GivesBackWhatTheProgramPrints) {
  // More than a pipe holds: a program that prints while it still reads must not block.
  const std::string input(1 << 20, 'x');
  const ProcessOutput output = RunForOutput({"cat"}, input, kEnough);
  EXPECT_EQ(output.end, End::kDone);
  EXPECT_EQ(output.text, input);
}

TEST(Process, RunsInTheCLocale) {
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  const ProcessOutput output = RunForOutput({"sh", "-c", "echo $LC_ALL"}, "", kEnough);
  unsetenv("LC_ALL");
  EXPECT_EQ(output.text, "C.UTF-8\n");
}

TEST(Process, SaysThatAProgramIsMissing) {
  EXPECT_EQ(RunForOutput({"no-such-program-1f2e"}, "", kEnough).end, End::kNotFound);
}

TEST(Process, SaysThatAProgramFailed) {
  EXPECT_EQ(RunForOutput({"false"}, "", kEnough).end, End::kFailed);
  EXPECT_EQ(RunForOutput({"sh", "-c", "kill -9 $$"}, "", kEnough).end, End::kFailed);
}

TEST(Process, EndsAProgramThatTakesTooLong) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(RunForOutput({"sleep", "60"}, "", std::chrono::milliseconds(50)).end, End::kTimeOut);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

}  // namespace
}  // namespace dhcal
