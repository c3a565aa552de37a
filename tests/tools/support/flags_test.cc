// Flags that each hold one text.
#include "tools/support/flags.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace dhcal {
namespace {

struct Taken {
  std::string wrong, data_dir, out;
  bool split = false;
};

Taken Take(std::vector<std::string> arguments) {
  Taken taken;
  arguments.insert(arguments.begin(), "program");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  Flags flags;
  flags.texts = {{"data_dir", &taken.data_dir}, {"out", &taken.out}};
  flags.switches = {{"split", &taken.split}};
  taken.wrong = TakeFlags(static_cast<int>(argv.size()), argv.data(), flags);
  return taken;
}

TEST(Flags, AreWrittenWithAnEqualsSignOrWithout) {
  const Taken taken = Take({"--data-dir", "a b", "--split", "--out=x=y"});
  EXPECT_EQ(taken.wrong, "");
  EXPECT_EQ(taken.data_dir, "a b");
  EXPECT_EQ(taken.out, "x=y");
  EXPECT_TRUE(taken.split);
  EXPECT_EQ(Take({"--data_dir=z"}).data_dir, "z");
  EXPECT_EQ(Take({"--out="}).wrong, "");
}

TEST(Flags, OthersAreNamed) {
  EXPECT_EQ(Take({"--out"}).wrong, "--out") << "without its value";
  EXPECT_EQ(Take({"--split=yes"}).wrong, "--split=yes");
  EXPECT_EQ(Take({"--oops", "1"}).wrong, "--oops");
  EXPECT_EQ(Take({"--out", "a", "b"}).wrong, "b");
}

TEST(Flags, WordsAreTakenWhereTheProgramHasSome) {
  std::vector<std::string> arguments = {"program", "a.png", "--split", "b.png"}, words;
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  bool split = false;
  Flags flags;
  flags.switches = {{"split", &split}};
  flags.words = &words;
  EXPECT_EQ(TakeFlags(static_cast<int>(argv.size()), argv.data(), flags), "");
  EXPECT_EQ(words, (std::vector<std::string>{"a.png", "b.png"}));
  EXPECT_TRUE(split);
}

}  // namespace
}  // namespace dhcal
