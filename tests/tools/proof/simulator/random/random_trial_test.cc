// Random trials: the same for the same seed, readable as problem files, sealed, and as varied as
// they claim.

#include "tools/proof/simulator/random/random_trial.h"

#include <map>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/sanitized.h"
#include "tests/tools/proof/simulator/read_back.h"
#include "tools/proof/simulator/random/poses.h"
#include "tools/proof/simulator/random/random_files.h"

namespace dhcal::concealed {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(RandomTrials, AreTheSameForTheSameSeedAndOthersForAnother) {
  for (const int seed : {1, 2}) {
    const CaseFiles once = FilesOf(MakeRandomTrial(seed)), again = FilesOf(MakeRandomTrial(seed));
    EXPECT_EQ(once.name, NameOfRandom(seed));
    EXPECT_EQ(once.problem, again.problem);
    EXPECT_EQ(once.recording, again.recording);
    EXPECT_EQ(once.answer, again.answer);
    EXPECT_NE(once.recording, FilesOf(MakeRandomTrial(seed + 10)).recording);
  }
}

/// Of one seed each.
class RandomSeed : public ::testing::TestWithParam<int> {};

TEST_P(RandomSeed, GivesFilesThatTheProgramReadsAndAnAnswerThatItDoesNotSee) {
  const RandomTrial trial = MakeRandomTrial(GetParam());
  const CaseFiles files = FilesOf(trial);
  const ReadCase read = ReadBack(files);
  ASSERT_TRUE(read.spec && read.recording) << read.diagnostics.ToString();
  if (trial.columns.empty()) {
    EXPECT_EQ(read.diagnostics.ToString(), "") << "no unknown column";
  } else {
    EXPECT_THAT(read.diagnostics.ToString(), HasSubstr("kept as possible drivers"));
  }
  EXPECT_EQ(read.recording->extra.size(), trial.columns.size());
  EXPECT_EQ(read.recording->num_rows(), trial.motion.num_poses());
  EXPECT_THAT(files.problem, HasSubstr(Sha256(files.answer)));
  EXPECT_THAT(files.problem, Not(HasSubstr("effect")));
  EXPECT_THAT(files.problem, Not(HasSubstr("beta")));
}

TEST_P(RandomSeed, RoundsJointAnglesInTheFileOnly) {
  if (kSanitized) GTEST_SKIP() << "the test before runs the same code";
  const RandomTrial trial = MakeRandomTrial(GetParam());
  if (trial.settings.order == Order::kGrid) GTEST_SKIP() << "round by itself";
  const Eigen::VectorXd quanta = ReadOutQuanta(trial.settings, trial.drawing);
  const Eigen::ArrayXXd places = (trial.motion.q * quanta.cwiseInverse().asDiagonal()).array();
  EXPECT_GT((places - places.round()).abs().maxCoeff(), 0.4) << "the arm is where it is";
  const std::string csv = FilesOf(trial).recording;
  const std::string first =
      csv.substr(csv.find('\n') + 1, csv.find(',', csv.find('\n')) - csv.find('\n') - 1);
  EXPECT_EQ(static_cast<int>(first.size() - first.find('.') - 1), trial.settings.decimals);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomSeed, ::testing::Range(1, 25));

TEST(RandomSettings, TakeEveryValueThatTheyMay) {
  std::map<std::string, std::set<std::string>> seen;
  Rng rng(11);
  for (int k = 0; k < 2000; ++k) {
    const Settings s = DrawSettings(&rng);
    seen["robot"].insert(s.robot);
    seen["kind"].insert(ToString(s.kind));
    seen["order"].insert(ToString(s.order));
    seen["tail"].insert(ToString(s.tail));
    seen["sigma"].insert(ToString(s.sigma));
    seen["masses"].insert(ToString(s.masses));
    seen["setups"].insert(ToString(s.setups));
    seen["decimals"].insert(std::to_string(s.decimals));
    seen["repeats"].insert(std::to_string(s.repeats));
    seen["targets"].insert(std::to_string(s.targets));
    EXPECT_GE(s.rows, 60);
    EXPECT_LE(s.rows, 2000);
    EXPECT_TRUE(s.sigma_factor == 1 || s.sigma == Said::kWrong);
    EXPECT_TRUE(s.complete || s.kind != Kind::kDistance) << "distances alone hold no base";
  }
  const std::map<std::string, std::size_t> values = {{"robot", 6},
                                                     {"kind", 4},
                                                     {"order", 4},
                                                     {"tail", 3},
                                                     {"sigma", 3},
                                                     {"masses", 3},
                                                     {"setups", 3},
                                                     {"decimals", 5},
                                                     {"repeats", 3},
                                                     {"targets", 3}};
  for (const auto& [name, count] : values) EXPECT_EQ(seen[name].size(), count) << name;
}

TEST(RandomPoses, StayInTheRangeAndRepeatsStandStill) {
  Rng rng(3);
  for (int k = 0; k < 60; ++k) {
    const Settings s = DrawSettings(&rng);
    const Arm arm = DrawArm(s, &rng);
    const Motion motion = DrawMotion(s, arm, &rng);
    const Eigen::MatrixXd off = (motion.q.rowwise() - arm.middle.transpose()).cwiseAbs();
    EXPECT_LE((off.rowwise() - arm.wide.transpose()).maxCoeff(), 1e-12);
    for (int row = 0; row < motion.num_poses(); ++row) {
      if (row % s.repeats == 0) continue;
      EXPECT_EQ(motion.q.row(row), motion.q.row(row - 1));
    }
    if (s.order != Order::kStreamed) continue;
    // Speeds are those of the path.
    const double step = motion.time[1] - motion.time[0];
    const Eigen::RowVectorXd middle = (motion.q.row(11) - motion.q.row(9)) / (2 * step);
    EXPECT_LT((middle - motion.speed.row(10)).norm(), 0.05 * motion.speed.norm());
  }
}

TEST(RandomPoses, TheRowBeforeIsOfTheSameRunAndTarget) {
  Motion motion;
  motion.q = Eigen::MatrixXd::Zero(6, 1);
  motion.run = {1, 1, 1, 1, 2, 2};
  motion.target = {0, 1, 0, 1, 0, 0};
  EXPECT_EQ(RowsBefore(motion), (std::vector<int>{-1, -1, 0, 1, -1, 4}));
}

}  // namespace
}  // namespace dhcal::concealed
