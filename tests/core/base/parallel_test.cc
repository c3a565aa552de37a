// Every piece is done once, and all are done at the return.
#include "core/base/parallel.h"

#include <vector>

#include <gtest/gtest.h>

namespace dhcal {
namespace {

TEST(ParallelFor, DoesEachPieceOnce) {
  for (const int count : {1, 2, 7, 1000}) {
    std::vector<int> times(static_cast<std::size_t>(count), 0);
    ParallelFor(count, [&](int k) { ++times[static_cast<std::size_t>(k)]; });
    EXPECT_EQ(times, std::vector<int>(static_cast<std::size_t>(count), 1));
  }
}

TEST(ParallelFor, DoesAllOnOneThreadOrOnMoreThanThereAreProcessors) {
  for (const int threads : {1, 2 * NumProcessors() + 1}) {
    std::vector<int> times(50, 0);
    ParallelFor(
        50, [&](int k) { ++times[static_cast<std::size_t>(k)]; }, threads);
    EXPECT_EQ(times, std::vector<int>(50, 1)) << threads;
  }
}

TEST(ParallelFor, DoesNothingWhereThereIsNothingToDo) {
  ParallelFor(0, [](int /*k*/) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace dhcal
