// Varying the deciding numbers: none is forgotten, and one changes at a time.
#include "tools/study/vary.h"

#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dhcal {
namespace {

using ::testing::Each;
using ::testing::Ne;

TEST(VaryTest, NoNumberOfTheTuningIsMissingFromTheList) {
  static_assert(sizeof(Tuning) % sizeof(std::uint64_t) == 0);
  constexpr std::uint64_t kUntouched = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> bytes(sizeof(Tuning) / sizeof(std::uint64_t), kUntouched);
  Tuning tuning;
  std::memcpy(static_cast<void*>(&tuning), bytes.data(), sizeof tuning);
  for (const TuningNumber& number : TuningNumbers()) {
    if (number.real != nullptr) {
      tuning.*number.real = 0;
    } else {
      tuning.*number.count = 0;
    }
  }
  std::memcpy(bytes.data(), &tuning, sizeof tuning);
  EXPECT_THAT(bytes, Each(Ne(kUntouched)));
}

TEST(VaryTest, NamesAreDistinctAndEachHasOneMember) {
  std::set<std::string> names;
  for (const TuningNumber& number : TuningNumbers()) {
    EXPECT_TRUE(names.insert(number.name).second) << number.name;
    EXPECT_NE(number.real != nullptr, number.count != nullptr) << number.name;
  }
}

TEST(VaryTest, OneNumberChangesAndTheOthersStay) {
  const Tuning before;
  const std::vector<TuningNumber> numbers = TuningNumbers();
  for (const TuningNumber& varied : numbers) {
    const Tuning after = Varied(before, varied, 2);
    for (const TuningNumber& n : numbers) {
      const double factor = n.name == varied.name ? 2 : 1;
      if (n.real != nullptr) {
        EXPECT_DOUBLE_EQ(after.*n.real, factor * before.*n.real) << varied.name << " " << n.name;
      } else {
        EXPECT_EQ(after.*n.count, static_cast<int>(factor) * before.*n.count)
            << varied.name << " " << n.name;
      }
    }
  }
}

TEST(VaryTest, ACountStaysAtLeastOne) {
  Tuning tuning;
  tuning.rounds = 1;
  for (const TuningNumber& number : TuningNumbers()) {
    if (number.name == "rounds") {
      EXPECT_EQ(Varied(tuning, number, 0.1).rounds, 1);
    }
  }
}

}  // namespace
}  // namespace dhcal
